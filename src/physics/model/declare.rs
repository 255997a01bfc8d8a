//! What each line of the table in `fields.rs` turns into: a field of `Model`, its allocation, reflection by name, and
//! reading from a compiled file.

macro_rules! model {
    (sizes { $($size:ident $count:literal,)* } arrays { $($field:ident : $t:ident $shape:tt $doc:literal,)* }) => {
        /// The numbers of a [`Model`](crate::Model): options, sizes, arrays.
        ///
        /// Every array has MuJoCo's name and holds MuJoCo's numbers; the doc of each begins with its shape, rows
        /// first. References to other elements are indices, -1 for none.
        #[derive(Clone, Debug, Default)]
        #[allow(non_snake_case)]
        pub struct Arrays {
            /// Name of the model.
            pub name: String,
            /// Simulation options.
            pub opt: Options,
            /// Visualisation options; the physics does not read them.
            pub vis: Visual,
            /// Statistics of the model at `qpos0`.
            pub stat: Statistic,
            /// Some body has gravity compensation.
            pub flg_gravcomp: bool,
            /// Some geom has a surface velocity.
            pub flg_surfacevel: bool,
            /// Some geom or pair has adhesion.
            pub flg_adhesion: bool,
            $(#[doc = $count] pub $size: usize,)*
            $(#[doc = concat!("`", stringify!($shape), "` ", $doc)] pub $field: field_type!($t, $shape),)*
        }

        impl Arrays {
            /// Allocates every array, zeroed, from the sizes set so far.
            pub fn allocate(&mut self) {
                $({
                    let (rows, width) = (field_rows!(self, $shape), field_width!(self, $shape));
                    Field::allocate(&mut self.$field, rows, width);
                })*
            }

            /// Calls `f(name, value)` for every size.
            pub fn visit_sizes(&self, f: &mut dyn FnMut(&'static str, usize)) {
                $(f(stringify!($size), self.$size);)*
            }

            /// Sets a size by name; false when there is no such size.
            pub fn set_size(&mut self, name: &str, value: usize) -> bool {
                match name {
                    $(stringify!($size) => self.$size = value,)*
                    _ => return false,
                }
                true
            }

            /// Calls `f(name, shape, values)` for every array, in declaration order.
            pub fn visit(&self, f: &mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) {
                $(f(stringify!($field), field_shape!(self, $shape), Field::scalars(&self.$field));)*
            }

            /// Overwrites the array called `name`; `None` when there is none, `Some(false)` on a size mismatch.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $(stringify!($field) => {
                        let expected: usize = field_shape!(self, $shape).iter().product();
                        Some(expected == values.len() && Field::assign(&mut self.$field, values))
                    })*
                    _ => None,
                }
            }

            /// Names of all sizes; name, type and shape of all arrays, in declaration order.
            pub(super) const LAYOUT: &str = concat!(
                $(stringify!($size), "\n",)*
                $(stringify!($field), ":", stringify!($t), stringify!($shape), "\n",)*
            );

            /// Bytes of every array in a compiled file, by the sizes set so far; `None` beyond all numbers.
            pub(crate) fn array_bytes(&self) -> Option<Vec<u64>> {
                Some(vec![$(array_bytes(
                    &self.$field,
                    field_rows!(self, $shape),
                    field_width!(self, $shape),
                )?,)*])
            }

            /// Bytes of all arrays, by the sizes set so far.
            pub fn bytes(&self) -> usize {
                let sum = |all: Vec<u64>| all.into_iter().try_fold(0, u64::checked_add);
                self.array_bytes().and_then(sum).and_then(|n| n.try_into().ok()).unwrap_or(usize::MAX)
            }

            /// Fills the arrays of these numbers, in declaration order, by the sizes set so far.
            pub(crate) fn read_arrays(
                &mut self,
                from: &mut Reader<'_>,
                numbers: std::ops::Range<usize>,
            ) -> Result<(), BinaryError> {
                let mut number = 0;
                $(
                    if numbers.contains(&number) {
                        let (rows, width) = (field_rows!(self, $shape), field_width!(self, $shape));
                        from.array(&mut self.$field, rows * width)?;
                    }
                    number += 1;
                )*
                _ = number;
                Ok(())
            }

            /// Takes the arrays from number `first` on from another model.
            pub(crate) fn take_arrays(&mut self, other: &mut Arrays, first: usize) {
                let mut number = 0;
                $(
                    if number >= first {
                        self.$field = std::mem::take(&mut other.$field);
                    }
                    number += 1;
                )*
                _ = number;
            }
        }
    };
}

pub(super) use model;
