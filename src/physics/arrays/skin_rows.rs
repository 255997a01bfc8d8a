//! The table of skins: their sizes and arrays, put into the table of the model by a macro that `fields.rs` calls.

/// Calls `model_with_flexes!` with the given rows and the rows of skins: sizes after the given ones, arrays before the last
/// list, where MuJoCo declares them.
macro_rules! model_with_skins {
    (sizes { $($sizes:tt)* } arrays { $($first:tt)* } flexes arrays { $($before:tt)* } skins arrays { $($after:tt)* }) => {
        model_with_flexes! {
            sizes {
                $($sizes)*
                nskin           "Skins.",
                nskinvert       "Vertices of all skins.",
                nskintexvert    "Vertices of skins that have texture coordinates.",
                nskinface       "Triangles of all skins.",
                nskinbone       "Bones of all skins.",
                nskinbonevert   "Vertices of all bones, summed.",
            }
            arrays {
                $($first)*
            }
            flexes arrays {
                $($before)*

                skin_matid: i32 [nskin]                   "Material, -1 for none.",
                skin_group: i32 [nskin]                   "Group for visibility.",
                skin_rgba: f32 [nskin; 4]                 "Colour and opacity.",
                skin_inflate: f32 [nskin]                 "Distance by which vertices move along their normals \\[m\\].",
                skin_vertadr: i32 [nskin]                 "First vertex.",
                skin_vertnum: i32 [nskin]                 "Number of vertices.",
                skin_texcoordadr: i32 [nskin]             "First texture coordinate, -1 for none.",
                skin_faceadr: i32 [nskin]                 "First triangle.",
                skin_facenum: i32 [nskin]                 "Number of triangles.",
                skin_boneadr: i32 [nskin]                 "First bone.",
                skin_bonenum: i32 [nskin]                 "Number of bones.",
                skin_vert: f32 [nskinvert; 3]             "Vertices in the bind pose \\[m\\].",
                skin_texcoord: f32 [nskintexvert; 2]      "Texture coordinates of vertices.",
                skin_face: i32 [nskinface; 3]             "Vertices of a triangle, counted from `skin_vertadr`.",
                skin_bonevertadr: i32 [nskinbone]         "First of its vertices.",
                skin_bonevertnum: i32 [nskinbone]         "Number of its vertices.",
                skin_bonebindpos: f32 [nskinbone; 3]      "Position of the body in the bind pose \\[m\\].",
                skin_bonebindquat: f32 [nskinbone; 4]     "Orientation of the body in the bind pose.",
                skin_bonebodyid: i32 [nskinbone]          "Body that moves the vertices.",
                skin_bonevertid: i32 [nskinbonevert]      "A vertex, counted from `skin_vertadr`.",
                skin_bonevertweight: f32 [nskinbonevert]  "Its weight; those of a vertex add up to 1.",
                skin_pathadr: i32 [nskin]                 "First byte of its path, -1 for none.",

                $($after)*
            }
        }
    };
}

pub(super) use model_with_skins;
