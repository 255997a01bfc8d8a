//! What each line of the table in `fields.rs` turns into: a field of `Model`, its allocation, reflection by name, and
//! reading from a compiled file.

/// What the rows of an array are numbered by; arrays of run-time width are flat, and numbered by nothing.
macro_rules! row_count {
    ([$rows:ident $(; $n:literal)?]) => {
        counts::$rows
    };
    ([$rows:ident, $w:ident $(; $n:literal)?]) => {
        counts::Flat
    };
}

macro_rules! model {
    (sizes { $($size:ident $count:literal,)* } arrays { $($field:ident : $t:ident $shape:tt $doc:literal,)* }) => {
        /// The numbers of a `Model`: options, sizes, arrays, in one of three [forms](Form).
        ///
        /// Every array has MuJoCo's name and holds MuJoCo's numbers; the doc of each begins with its shape, rows
        /// first. References to other elements are indices, -1 for none.
        #[allow(non_snake_case)]
        pub struct Columns<F: Form> {
            /// Name of the model.
            pub name: F::Label,
            /// Simulation options.
            pub opt: F::Group<Options>,
            /// Visualisation options; the physics does not read them.
            pub vis: F::Group<Visual>,
            /// Statistics of the model at `qpos0`.
            pub stat: F::Group<Statistic>,
            /// Some body has gravity compensation.
            pub flg_gravcomp: bool,
            /// Some geom has a surface velocity.
            pub flg_surfacevel: bool,
            /// Some geom or pair has adhesion.
            pub flg_adhesion: bool,
            $(#[doc = $count] pub $size: usize,)*
            $(#[doc = concat!("`", stringify!($shape), "` ", $doc)]
            pub $field: F::Column<row_type!($t, $shape), row_count!($shape)>,)*
        }

        /// The numbers of a `Model`, to read.
        pub type Arrays = Columns<Finished>;

        /// The numbers of a model to which a compiler appends row by row.
        pub type Rows = Columns<Growing>;

        /// The numbers of a `Model`, to write: no size and no length can change.
        pub type Draft<'a> = Columns<Drafted<'a>>;

        /// What numbers the rows of an array: one type for each size of a model.
        pub mod counts {
            $(#[doc = $count] #[allow(non_camel_case_types)] #[derive(Debug)] pub enum $size {})*
            /// Rows of run-time width are stored flat; single numbers belong to no element.
            #[derive(Debug)]
            pub enum Flat {}
        }

        /// One of the arrays.
        #[allow(non_camel_case_types)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum ArrayId {
            $($field,)*
        }

        impl ArrayId {
            /// All of them, in declaration order.
            pub(crate) const ALL: &[ArrayId] = &[$(ArrayId::$field,)*];
        }

        /// Names of the sizes, in declaration order.
        const SIZES: &[&str] = &[$(stringify!($size),)*];

        impl<F: Owned> Default for Columns<F>
        where
            F::Label: Default,
            F::Group<Options>: Default,
            F::Group<Visual>: Default,
            F::Group<Statistic>: Default,
        {
            fn default() -> Self {
                Columns {
                    name: Default::default(),
                    opt: Default::default(),
                    vis: Default::default(),
                    stat: Default::default(),
                    flg_gravcomp: false,
                    flg_surfacevel: false,
                    flg_adhesion: false,
                    $($size: 0,)*
                    $($field: F::empty(),)*
                }
            }
        }

        impl Clone for Arrays {
            /// Shares every array.
            fn clone(&self) -> Self {
                Columns {
                    name: self.name.clone(),
                    opt: self.opt.clone(),
                    vis: self.vis.clone(),
                    stat: self.stat.clone(),
                    $($field: self.$field.clone(),)*
                    ..*self
                }
            }
        }

        impl std::fmt::Debug for Arrays {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let mut show = f.debug_struct("Arrays");
                show.field("name", &self.name).field("opt", &self.opt).field("stat", &self.stat);
                self.visit_sizes(&mut |name, size| _ = show.field(name, &size));
                self.visit(&mut |name, _, values| _ = show.field(name, &values));
                show.finish()
            }
        }

        impl Rows {
            /// The arrays, as long as they are now.
            pub fn finish(mut self) -> Arrays {
                // Field by field into whole values: one expression that moves all fields must be able to drop every part
                // of itself at each of them, which takes a megabyte of code.
                let mut arrays = Arrays::default();
                arrays.name = std::mem::take(&mut self.name);
                arrays.opt = std::mem::take(&mut self.opt);
                arrays.vis = std::mem::take(&mut self.vis);
                arrays.stat = std::mem::take(&mut self.stat);
                arrays.flg_gravcomp = self.flg_gravcomp;
                arrays.flg_surfacevel = self.flg_surfacevel;
                arrays.flg_adhesion = self.flg_adhesion;
                $(arrays.$size = self.$size;)*
                $(arrays.$field.fill(std::mem::take(&mut self.$field));)*
                arrays
            }
        }

        impl Draft<'_> {
            /// Overwrites the array called `name`; `None` when there is none, `Some(false)` on a size mismatch.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $(stringify!($field) => Some(self.$field.assign(values)),)*
                    _ => None,
                }
            }

            /// The sizes, in declaration order.
            pub(crate) fn sizes(&self) -> [usize; SIZES.len()] {
                [$(self.$size,)*]
            }
        }

        impl Arrays {
            /// The numbers to write; what they were is kept until [`Arrays::settle`] or [`Arrays::revert`].
            pub(crate) fn draft(&mut self) -> Draft<'_> {
                Columns {
                    name: &self.name,
                    opt: &mut self.opt,
                    vis: &mut self.vis,
                    stat: &mut self.stat,
                    flg_gravcomp: self.flg_gravcomp,
                    flg_surfacevel: self.flg_surfacevel,
                    flg_adhesion: self.flg_adhesion,
                    $($size: self.$size,)*
                    $($field: Writer(&mut self.$field),)*
                }
            }

            /// Name, value and given value of the first size that differs from the given ones.
            pub(crate) fn different_size(&self, given: &[usize]) -> Option<(&'static str, usize, usize)> {
                let own = [$(self.$size,)*];
                let at = (0..SIZES.len()).find(|&i| own[i] != given[i])?;
                Some((SIZES[at], own[at], given[at]))
            }

            /// Calls `f` for every array that the edit under way wrote, in declaration order.
            pub(crate) fn visit_written_ids(&self, f: &mut dyn FnMut(ArrayId)) {
                $(if self.$field.is_written() {
                    f(ArrayId::$field);
                })*
            }

            /// Calls `f(name, before, now)` for every array that the edit under way wrote.
            pub(crate) fn visit_written(&self, f: &mut dyn FnMut(&'static str, Slice<'_>, Slice<'_>)) {
                $(if self.$field.is_written() {
                    f(stringify!($field), Row::scalars(self.$field.before()), Row::scalars(&self.$field));
                })*
            }

            /// Accepts what the edit under way wrote.
            pub(crate) fn settle(&mut self) {
                $(self.$field.settle();)*
            }

            /// Takes back what the edit under way wrote to arrays.
            pub(crate) fn revert(&mut self) {
                $(self.$field.revert();)*
            }

            /// These numbers with the arrays as they were before the edit under way.
            pub(crate) fn previous(&self) -> Arrays {
                Columns {
                    name: self.name.clone(),
                    opt: self.opt.clone(),
                    vis: self.vis.clone(),
                    stat: self.stat.clone(),
                    $($field: self.$field.previous(),)*
                    ..*self
                }
            }

            /// Allocates every array, zeroed, from the sizes set so far.
            pub fn allocate(&mut self) {
                $({
                    let (rows, width) = (field_rows!(self, $shape), field_width!(self, $shape));
                    Field::allocate(&mut self.$field, rows, width);
                })*
            }

            /// True when every array is shared with `other`: nothing but settings, options and the name can then differ.
            pub fn shares(&self, other: &Arrays) -> bool {
                $(std::ptr::eq(&*self.$field, &*other.$field))&&*
            }

            /// Calls `f(name, value)` for every size.
            pub fn visit_sizes(&self, f: &mut dyn FnMut(&'static str, usize)) {
                $(f(stringify!($size), self.$size);)*
            }

            /// Calls `f(name, flag)` for what the model uses at all, in order of declaration.
            pub fn visit_flags(&self, f: &mut dyn FnMut(&'static str, bool)) {
                f("flg_gravcomp", self.flg_gravcomp);
                f("flg_surfacevel", self.flg_surfacevel);
                f("flg_adhesion", self.flg_adhesion);
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

            /// The array that [`Arrays::visit`] calls at `number`, counted from 0.
            pub fn array(&self, number: usize) -> Option<Slice<'_>> {
                ArrayId::ALL.get(number).map(|id| match id {
                    $(ArrayId::$field => Field::scalars(&self.$field),)*
                })
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
            pub(crate) const LAYOUT: &str = concat!(
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
            ) -> Result<(), ReadError> {
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

pub(super) use {model, row_count};
