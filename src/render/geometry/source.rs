//! The arrays of a model that its triangles and textures depend on, kept to see what an edit changed.

use physics::Model;
use physics::model::array::Array;
use physics::model::counts;

macro_rules! source {
    ($($group:ident { $($field:ident: $row:ty [$count:ident],)* })*) => {
        /// Arrays of a model. Clones share memory with it, and equal addresses mean equal contents: an array that
        /// somebody else holds is copied before it is written.
        #[derive(Clone, Debug, Default)]
        pub(super) struct Source {
            $($(pub $field: Array<$row, counts::$count>,)*)*
        }

        impl Source {
            pub fn of(model: &Model) -> Self {
                Source { $($($field: model.$field.clone(),)*)* }
            }

            /// Every array is still the one of the model.
            pub fn is_current(&self, model: &Model) -> bool {
                $($(shared(&self.$field, &model.$field))&&*)&&*
            }

            $(
                #[doc = "Some array of this group has other contents in the model."]
                pub fn $group(&self, model: &Model) -> bool {
                    $(!same(&self.$field, &model.$field))||*
                }
            )*
        }
    };
}

source! {
    layout_moved {
        mesh_vertadr: i32 [nmesh],
        mesh_vertnum: i32 [nmesh],
        mesh_faceadr: i32 [nmesh],
        mesh_facenum: i32 [nmesh],
        mesh_normaladr: i32 [nmesh],
        mesh_normalnum: i32 [nmesh],
        mesh_texcoordadr: i32 [nmesh],
        mesh_texcoordnum: i32 [nmesh],
        mesh_vert: [f32; 3] [nmeshvert],
        mesh_normal: [f32; 3] [nmeshnormal],
        mesh_texcoord: [f32; 2] [nmeshtexcoord],
        mesh_face: [i32; 3] [nmeshface],
        mesh_facenormal: [i32; 3] [nmeshface],
        mesh_facetexcoord: [i32; 3] [nmeshface],
        mesh_graphadr: i32 [nmesh],
        mesh_graph: i32 [nmeshgraph],
        skin_vertadr: i32 [nskin],
        skin_vertnum: i32 [nskin],
        skin_texcoordadr: i32 [nskin],
        skin_faceadr: i32 [nskin],
        skin_facenum: i32 [nskin],
        skin_texcoord: [f32; 2] [nskintexvert],
        skin_face: [i32; 3] [nskinface],
        flex_vertadr: i32 [nflex],
        hfield_nrow: i32 [nhfield],
        hfield_ncol: i32 [nhfield],
        hfield_adr: i32 [nhfield],
        tex_type: i32 [ntex],
        tex_colorspace: i32 [ntex],
        tex_height: i32 [ntex],
        tex_width: i32 [ntex],
        tex_nchannel: i32 [ntex],
        tex_adr: i64 [ntex],
    }
    hfields_moved {
        hfield_size: [f64; 4] [nhfield],
        hfield_data: f32 [nhfielddata],
    }
    pixels_moved {
        tex_data: u8 [ntexdata],
    }
    planes_moved {
        geom_type: i32 [ngeom],
        geom_size: [f64; 3] [ngeom],
        geom_matid: i32 [ngeom],
        mat_texrepeat: [f32; 2] [nmat],
    }
    materials_moved {
        mat_texid: [i32; 10] [nmat],
        mat_texuniform: bool [nmat],
    }
}

fn shared<R, N>(a: &Array<R, N>, b: &Array<R, N>) -> bool {
    a.as_ptr() == b.as_ptr() && a.len() == b.len()
}

fn same<R: PartialEq, N>(a: &Array<R, N>, b: &Array<R, N>) -> bool {
    shared(a, b) || a[..] == b[..]
}
