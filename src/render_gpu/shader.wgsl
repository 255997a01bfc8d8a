// Everything that is drawn. Positions of the world are relative to the eye of their picture. Row 0 of every target is the
// lowest row of a picture, so that the pattern of samples is OpenGL's.

// Texture of a pipeline: 0 none, 1 flat, 2 cube.
override PAINT: u32 = 0u;
// Samples of a pixel.
override SAMPLES: u32 = 4u;

// One pass over one picture.
struct Pass {
    // Rows that take a point of the world to clip coordinates.
    clip: array<vec4f, 4>,
    // Rows that take it to the texels of a shadow map: column, row, depth and w.
    map: array<vec4f, 4>,
    // Plane of the mirror: what is at or above it is mirrored.
    mirror: vec4f,
    // Where highlights are seen from; w: factor of the items' own colours.
    eye: vec4f,
    // Colour of fog; w: 1 with fog, 0 without.
    fog: vec4f,
    // Row that gives the distance from the eye's plane.
    depth: vec4f,
    // Beginning and end of fog, ambient light, texels along a side of the shadow map.
    numbers: vec4f,
    // First light, bits of those that light, layer of the shadow map, slices of the sky.
    counts: vec4u,
    // Axes of the haze's plane; w: radius of the sky, height of the eye over the plane, share of the radius that is haze.
    around: array<vec4f, 3>,
    // Colour of haze; w: height of its densest ring, 0 on the plane and 1 at the eye.
    haze: vec4f,
    // Gaze; w: 1 for parallel rays.
    gaze: vec4f,
    // Columns and rows of the picture; z: 1 where depth in the shadow map is reversed; w: what is added to that depth.
    window: vec4f,
}

// A surface; of a line, the rows of `world` hold its two ends, and its width in pixels.
struct Instance {
    // Rows that take a point of the surface to the world.
    world: array<vec4f, 3>,
    // Rows that take normals there; w: emission, specular, exponent of highlights.
    normals: array<vec4f, 3>,
    rgba: vec4f,
    // Factors of texture coordinates; w: 0 from the file, 1 from x and y, 2 from the position.
    scale: vec4f,
    // Added to texture coordinates.
    offset: vec2f,
    // Item, counted from 1.
    item: u32,
    unused: u32,
    // Columns that take a point of the surface to clip coordinates of the picture, rounded once.
    clip: array<vec4f, 4>,
}

struct Light {
    // w: 1 for a spot.
    pos: vec4f,
    // w: cosine of the spot's half angle.
    dir: vec4f,
    // w: exponent of the spot.
    ambient: vec4f,
    // w: constant fall with distance.
    diffuse: vec4f,
    // w: linear fall.
    specular: vec4f,
    // x: quadratic fall.
    more: vec4f,
}

@group(0) @binding(0) var<uniform> current: Pass;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
@group(0) @binding(2) var<storage, read> lights: array<Light>;
@group(1) @binding(0) var flat_texture: texture_2d<f32>;
@group(1) @binding(1) var cube_texture: texture_cube<f32>;
@group(1) @binding(2) var flat_sampler: sampler;
@group(1) @binding(3) var cube_sampler: sampler;
// Depths; as a depth texture they could not be read without a comparison in OpenGL.
@group(2) @binding(0) var shadow_maps: texture_2d_array<f32>;

struct Corner {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texture: vec2f,
}

struct Lit {
    @builtin(position) @invariant position: vec4f,
    @location(0) colour: vec3f,
    @location(1) texture: vec3f,
    @location(2) world: vec3f,
    @location(3) @interpolate(flat) alpha: f32,
    // Distance from the eye's plane; that of corners behind the eye counts as positive, as in Mesa.
    @location(4) away: f32,
}

fn times(rows: array<vec4f, 4>, point: vec3f) -> vec4f {
    let p = vec4f(point, 1.0);
    return vec4f(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p), dot(rows[3], p));
}

fn place(instance: u32, position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    let rows = instances[instance].world;
    return vec3f(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
}

// Clip coordinates of a point of a surface: of the picture itself, or of a mirror.
fn project(instance: u32, position: vec3f, world: vec3f) -> vec4f {
    if (current.counts.y & 512u) != 0u {
        return times(current.clip, world);
    }
    let columns = instances[instance].clip;
    return columns[0] * position.x + columns[1] * position.y + columns[2] * position.z + columns[3];
}

fn unit(v: vec3f) -> vec3f {
    let length = length(v);
    return v / select(1.0, length, length > 0.0);
}

// The power of a number from 0 to 1; 1 for an exponent of 0.
fn power(x: f32, exponent: f32) -> f32 {
    if exponent == 0.0 {
        return 1.0;
    }
    return select(pow(max(x, 1e-20), exponent), 0.0, x < 1e-20);
}

struct Surface {
    position: vec3f,
    normal: vec3f,
    base: vec3f,
    specular: f32,
    exponent: f32,
}

// What one light gives to a corner.
fn lamp(light: Light, at: Surface) -> vec3f {
    var to_light = -light.dir.xyz;
    var strength = 1.0;
    if light.pos.w != 0.0 {
        let away = light.pos.xyz - at.position;
        let distance = length(away);
        to_light = unit(away);
        let fall = light.diffuse.w + distance * (light.specular.w + distance * light.more.x);
        let along = -dot(to_light, light.dir.xyz);
        strength = select(power(clamp(along, 0.0, 1.0), light.ambient.w) / fall, 0.0, along < light.dir.w);
    }
    if !(strength > 0.0) {
        return vec3f(0.0);
    }
    let facing = dot(at.normal, to_light);
    var highlight = 0.0;
    if facing > 0.0 && at.specular > 0.0 {
        let middle = unit(to_light + unit(current.eye.xyz - at.position));
        highlight = at.specular * power(clamp(dot(at.normal, middle), 0.0, 1.0), at.exponent);
    }
    let body = (light.ambient.rgb + max(facing, 0.0) * light.diffuse.rgb) * at.base;
    return strength * (body + highlight * light.specular.rgb);
}

@vertex
fn corner(at: Corner, @builtin(instance_index) index: u32) -> Lit {
    let world = place(index, at.position);
    let rows = instances[index].normals;
    let look = vec3f(rows[0].w, rows[1].w, rows[2].w);
    let normal = unit(vec3f(dot(rows[0].xyz, at.normal), dot(rows[1].xyz, at.normal), dot(rows[2].xyz, at.normal)));
    let rgba = instances[index].rgba;
    let surface = Surface(world, normal, rgba.rgb * current.eye.w, look.y, look.z);
    // Emission and ambient light come with the first pass alone.
    var colour = surface.base * current.numbers.z;
    if (current.counts.y & 256u) != 0u {
        colour += surface.base * look.x;
    }
    for (var i = 0u; i < 8u; i++) {
        if ((current.counts.y >> i) & 1u) != 0u {
            colour += lamp(lights[current.counts.x + i], surface);
        }
    }
    var out: Lit;
    out.position = project(index, at.position, world);
    out.colour = clamp(colour, vec3f(0.0), vec3f(1.0));
    out.world = world;
    out.alpha = rgba.a;
    out.away = abs(dot(current.depth, vec4f(world, 1.0)));
    let scale = instances[index].scale;
    let offset = instances[index].offset;
    if scale.w == 0.0 {
        out.texture = vec3f(scale.xy * at.texture + offset, 0.0);
    } else if scale.w == 1.0 {
        out.texture = vec3f(scale.xy * at.position.xy - 0.5, 0.0);
    } else {
        out.texture = scale.xyz * at.position;
    }
    return out;
}

// Share of its own colour that fog leaves of what lies this far from the eye's plane.
fn clearness(depth: f32) -> f32 {
    return clamp((current.numbers.y - depth) / (current.numbers.y - current.numbers.x), 0.0, 1.0);
}

fn shade(in: Lit, fog: vec3f) -> vec4f {
    // Beyond the corners of a triangle colours may leave their range; they return to it with the texture's.
    var colour = in.colour;
    var alpha = in.alpha;
    if PAINT == 1u {
        let texel = textureSample(flat_texture, flat_sampler, in.texture.xy);
        colour *= texel.rgb;
        alpha *= texel.a;
    }
    if PAINT == 2u {
        let texel = textureSample(cube_texture, cube_sampler, in.texture);
        colour *= texel.rgb;
        alpha *= texel.a;
    }
    if current.fog.w != 0.0 {
        colour = mix(fog, colour, clearness(in.away));
    }
    return vec4f(colour, clamp(alpha, 0.0, 1.0));
}

@fragment
fn paint(in: Lit) -> @location(0) vec4f {
    return shade(in, current.fog.rgb);
}

// OpenGL's four places of samples, rows upwards.
const PLACES = array(vec2f(-0.125, -0.375), vec2f(0.375, -0.125), vec2f(-0.375, 0.125), vec2f(0.125, 0.375));

struct Mirrored {
    @location(0) colour: vec4f,
    @builtin(sample_mask) samples: u32,
}

@fragment
fn paint_mirrored(in: Lit) -> Mirrored {
    let above = dot(current.mirror, vec4f(in.world, 1.0));
    let slope = vec2f(dpdx(above), dpdy(above));
    var samples = 0u;
    if SAMPLES == 1u {
        samples = select(0u, 1u, above >= 0.0);
    } else {
        samples |= select(0u, 1u, above + dot(slope, PLACES[0]) >= 0.0);
        samples |= select(0u, 2u, above + dot(slope, PLACES[1]) >= 0.0);
        samples |= select(0u, 4u, above + dot(slope, PLACES[2]) >= 0.0);
        samples |= select(0u, 8u, above + dot(slope, PLACES[3]) >= 0.0);
    }
    return Mirrored(shade(in, current.fog.rgb), samples);
}

// The same by the middles of pixels.
@fragment
fn paint_mirrored_pixels(in: Lit) -> @location(0) vec4f {
    if dot(current.mirror, vec4f(in.world, 1.0)) < 0.0 {
        discard;
    }
    return shade(in, current.fog.rgb);
}

// Opacity from which on a surface takes the light of lamps that cast shadows: 252 in eight bits.
const OPAQUE = 251.5 / 255.0;

// Whether a lamp reaches a point: the map is asked at its nearest texel, and lights everything outside.
fn is_reached(world: vec3f) -> bool {
    let at = times(current.map, world);
    let place = floor(at.xy / at.w);
    let last = current.numbers.w - 1.0;
    if !(at.w > 0.0 && place.x >= 1.0 && place.y >= 1.0 && place.x < last && place.y < last) {
        return true;
    }
    let nearest = textureLoad(shadow_maps, vec2i(place), i32(current.counts.z), 0).x;
    let depth = clamp(at.z / at.w, 0.0, 1.0);
    let offset = current.window.w;
    return select(nearest + offset >= depth, depth + offset >= nearest, current.window.z != 0.0);
}

@fragment
fn paint_lamp(in: Lit) -> @location(0) vec4f {
    let colour = shade(in, vec3f(0.0));
    if colour.a < OPAQUE || !is_reached(in.world) {
        discard;
    }
    return colour;
}

@vertex
fn caster(at: Corner, @builtin(instance_index) index: u32) -> @builtin(position) vec4f {
    return times(current.clip, place(index, at.position));
}

struct Listed {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) item: u32,
}

@vertex
fn listed(at: Corner, @builtin(instance_index) index: u32) -> Listed {
    return Listed(project(index, at.position, at.position), instances[index].item);
}

// The item, and the bits of its depth.
@fragment
fn write_item(in: Listed) -> @location(0) vec2u {
    return vec2u(in.item, bitcast<u32>(in.position.z));
}

struct Line {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) item: u32,
    @location(1) @interpolate(flat) colour: vec3f,
}

// A rectangle about a line; with one sample a pixel, a parallelogram with two sides along columns or rows.
@vertex
fn line(@builtin(vertex_index) index: u32, @builtin(instance_index) number: u32) -> Line {
    let rows = instances[number].world;
    var a = times(current.clip, rows[0].xyz);
    var b = times(current.clip, rows[1].xyz);
    // What is left of it between the far plane and the near one.
    let near = vec2f(a.w - a.z, b.w - b.z);
    let far = vec2f(a.z, b.z);
    var out: Line;
    out.item = instances[number].item;
    out.colour = instances[number].rgba.rgb;
    if (near.x < 0.0 && near.y < 0.0) || (far.x < 0.0 && far.y < 0.0) {
        out.position = vec4f(2.0, 2.0, 2.0, 1.0);
        return out;
    }
    let whole = b - a;
    var ends = vec2f(0.0, 1.0);
    for (var face = 0u; face < 2u; face++) {
        let inside = select(far, near, face == 0u);
        let cut = inside.x / (inside.x - inside.y);
        ends.x = select(ends.x, max(ends.x, cut), inside.x < 0.0);
        ends.y = select(ends.y, min(ends.y, cut), inside.y < 0.0);
    }
    b = a + ends.y * whole;
    a = a + ends.x * whole;
    let window = 0.5 * current.window.xy;
    let along = (b.xy / b.w - a.xy / a.w) * window;
    let half = 0.5 * rows[2].x;
    var aside = vec2f(half, 0.0);
    if SAMPLES != 1u {
        aside = vec2f(-along.y, along.x) * half / max(length(along), 1.0 / 256.0);
    } else if abs(along.x) > abs(along.y) {
        aside = vec2f(0.0, half);
    }
    let at = select(a, b, index == 2u || index == 4u || index == 5u);
    let side = select(1.0, -1.0, index == 1u || index == 3u || index == 4u);
    out.position = vec4f(at.xy / at.w + side * aside / window, clamp(at.z / at.w, 0.0, 1.0), 1.0);
    return out;
}

@fragment
fn paint_line(in: Line) -> @location(0) vec4f {
    return vec4f(in.colour, 1.0);
}

@fragment
fn write_item_of_line(in: Line) -> @location(0) vec2u {
    return vec2u(in.item, bitcast<u32>(in.position.z));
}

// The upper side of what mirrors, at depth 0.
@vertex
fn opening(at: Corner, @builtin(instance_index) index: u32) -> @builtin(position) vec4f {
    let clip = project(index, at.position, at.position);
    if at.normal.z <= 0.5 {
        return vec4f(2.0, 2.0, 2.0, 1.0);
    }
    return vec4f(clip.xy, 0.0, clip.w);
}

// A triangle over the whole picture whose depth is the number of its instance.
@vertex
fn cover(@builtin(vertex_index) index: u32, @builtin(instance_index) depth: u32) -> @builtin(position) vec4f {
    let x = select(-1.0, 3.0, index == 1u);
    let y = select(-1.0, 3.0, index == 2u);
    return vec4f(x, y, f32(depth), 1.0);
}

@fragment
fn write_nothing() -> @location(0) vec4f {
    return vec4f(0.0);
}

struct Sky {
    @builtin(position) position: vec4f,
    @location(0) direction: vec3f,
    @location(1) world: vec3f,
}

const TURN = 6.283185307179586;

// A cylinder about the eye with flat slices: for each slice two triangles of its wall, and one of each end.
@vertex
fn sky(@builtin(vertex_index) index: u32) -> Sky {
    let slice = index / 12u;
    let part = index % 12u;
    // Columns 0 and 1 are the slice's edges, 2 is the axis.
    var columns = array(0u, 1u, 0u, 1u, 1u, 0u, 0u, 1u, 2u, 0u, 1u, 2u);
    var heights = array(-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0);
    let column = columns[part];
    let edge = (slice + column) % current.counts.w;
    let angle = TURN * f32(edge) / f32(current.counts.w);
    let reach = select(1.0, 0.0, column == 2u);
    let at = current.around[0].w * vec3f(reach * cos(angle), reach * sin(angle), heights[part]);
    return Sky(times(current.clip, at), select(at, current.gaze.xyz, current.gaze.w != 0.0), at);
}

@fragment
fn paint_sky(in: Sky) -> @location(0) vec4f {
    let d = in.direction;
    var colour = textureSample(cube_texture, cube_sampler, vec3f(d.x, d.z, -d.y)).rgb;
    if current.fog.w != 0.0 {
        colour = mix(current.fog.rgb, colour, clearness(dot(current.gaze.xyz, in.world)));
    }
    return vec4f(colour, 1.0);
}

struct Haze {
    @builtin(position) position: vec4f,
    @location(0) alpha: f32,
    @location(1) world: vec3f,
}

// Two rings of a cone over the horizon: from the plane up to the densest height, and from there to the eye's.
@vertex
fn haze(@builtin(vertex_index) index: u32) -> Haze {
    let slice = index / 12u;
    let part = index % 12u;
    var columns = array(0u, 1u, 0u, 1u, 1u, 0u, 0u, 1u, 0u, 1u, 1u, 0u);
    var levels = array(0u, 0u, 1u, 0u, 1u, 1u, 1u, 1u, 2u, 1u, 2u, 2u);
    let level = levels[part];
    let edge = (slice + columns[part]) % current.counts.w;
    let angle = TURN * f32(edge) / f32(current.counts.w);
    let height = select(select(0.0, current.haze.w, level == 1u), 1.0, level == 2u);
    let reach = current.around[0].w * (1.0 - current.around[2].w * (1.0 - height));
    let rise = current.around[1].w * (height - 1.0);
    let at = reach * (cos(angle) * current.around[0].xyz + sin(angle) * current.around[1].xyz)
        + rise * current.around[2].xyz;
    return Haze(times(current.clip, at), select(0.0, 1.0, level == 1u), at);
}

@fragment
fn paint_haze(in: Haze) -> @location(0) vec4f {
    var colour = current.haze.rgb;
    if current.fog.w != 0.0 {
        colour = mix(current.fog.rgb, colour, clearness(dot(current.gaze.xyz, in.world)));
    }
    return vec4f(colour, clamp(in.alpha, 0.0, 1.0));
}
