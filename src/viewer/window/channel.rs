//! What of the scene a picture shows: colours, distances, or which objects they are.

use crate::drawing::Scenery;
use eframe::egui::{Align2, Color32, FontId, Mesh, Painter, Rect, pos2, vec2};
use render::picture::Channels;
use render::{Picture, RenderError};
use video::{DEPTH_COLOURS, VideoError, depth_image, depth_range, object_number, segmentation_image};

/// What of the scene a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Channel {
    /// Colours.
    #[default]
    Colours,
    /// Distances from the camera's plane in false colours.
    Depth,
    /// Objects, each in a colour of its own.
    Objects,
}

/// Names of what a picture can show.
pub const CHANNELS: [(&str, Channel); 3] =
    [("Colours", Channel::Colours), ("Depth", Channel::Depth), ("Objects", Channel::Objects)];

impl Channel {
    /// What is drawn for it.
    fn channels(self) -> Channels {
        match self {
            Channel::Colours => Channels::RGB,
            Channel::Depth => Channels::DEPTH,
            Channel::Objects => Channels::SEGMENTATION,
        }
    }

    /// Draws it in colours, and says of depth which distances \[m\] have the first and the last.
    ///
    /// # Errors
    /// The size is zero or too large; what draws fails.
    pub fn draw(
        self,
        scenery: &Scenery,
        painter: &mut dyn render::Painter,
        picture: &mut Picture,
    ) -> Result<Option<[f32; 2]>, RenderError> {
        scenery.paint(painter, self.channels(), picture)?;
        self.colour(picture).map_err(|error| RenderError::Device { message: error.to_string() })
    }

    /// Gives a picture of these channels colours.
    fn colour(self, picture: &mut Picture) -> Result<Option<[f32; 2]>, VideoError> {
        let (width, height) = (picture.width as u32, picture.height as u32);
        let (image, scale) = match self {
            Channel::Colours => return Ok(None),
            Channel::Depth => {
                let (near, far) = depth_range(&picture.depth);
                (depth_image(width, height, &picture.depth, (near, far))?, Some([near, far]))
            }
            Channel::Objects => {
                let numbers: Vec<i32> = picture.segmentation.iter().copied().map(object_number).collect();
                (segmentation_image(width, height, &numbers)?, None)
            }
        };
        picture.rgb.clear();
        picture.rgb.extend_from_slice(image.frame().rgb());
        Ok(scale)
    }
}

/// Size of the scale of depth, and its distance from the edges of the picture \[point\].
const SCALE: [f32; 2] = [160.0, 12.0];
const MARGIN: f32 = 14.0;
/// Height of its letters \[point\].
const LETTERS: f32 = 12.0;

/// Draws what distances \[m\] the colours of depth stand for, over the lower edge of the picture, which is at `area`.
pub fn show_scale(painter: &Painter, area: Rect, [near, far]: [f32; 2]) {
    let painter = painter.with_clip_rect(area);
    let size = vec2(SCALE[0], SCALE[1]);
    let place =
        Rect::from_min_size(pos2(area.right() - MARGIN - size.x, area.bottom() - MARGIN - size.y), size);
    let words = Rect::from_min_max(place.left_top() - vec2(0.0, LETTERS + 4.0), place.right_top());
    painter.rect_filled(place.union(words).expand(6.0), 3.0, Color32::from_black_alpha(160));
    let mut mesh = Mesh::default();
    for (i, [r, g, b]) in DEPTH_COLOURS.into_iter().enumerate() {
        let x = place.left() + size.x * i as f32 / (DEPTH_COLOURS.len() - 1) as f32;
        let colour = Color32::from_rgb(r, g, b);
        mesh.colored_vertex(pos2(x, place.top()), colour);
        mesh.colored_vertex(pos2(x, place.bottom()), colour);
        if i > 0 {
            let last = 2 * i as u32 + 1;
            mesh.add_triangle(last - 3, last - 2, last - 1);
            mesh.add_triangle(last - 2, last - 1, last);
        }
    }
    painter.add(mesh);
    let font = FontId::monospace(LETTERS);
    let write = |at, anchor, distance: f32| {
        painter.text(at, anchor, format!("{distance:.3} m"), font.clone(), Color32::WHITE);
    };
    write(words.left_top(), Align2::LEFT_TOP, near);
    write(words.right_top(), Align2::RIGHT_TOP, far);
}
