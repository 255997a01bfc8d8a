//! What the table of a stage turns into: a struct of `Data`, its allocation, reflection by name.

/// Declares one stage struct of `Data`: arrays whose row counts are sizes of the `Model`.
macro_rules! stage {
    (
        $(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident : $t:ident $shape:tt,)* }
        $(scalars { $($(#[$sdoc:meta])* $scalar:ident : $st:ty,)* })?
    ) => {
        $(#[$meta])*
        #[derive(Debug, Default)]
        #[allow(non_snake_case)]
        pub struct $name {
            $($($(#[$sdoc])* pub $scalar: $st,)*)?
            $(#[doc = concat!("`", stringify!($shape), "`")] $(#[$doc])* pub $field: crate::table::field_type!($t, $shape),)*
        }

        impl Clone for $name {
            fn clone(&self) -> Self {
                $name {
                    $($($scalar: self.$scalar,)*)?
                    $($field: self.$field.clone(),)*
                }
            }

            /// Reuses the memory of `self`.
            fn clone_from(&mut self, from: &Self) {
                $($(self.$scalar = from.$scalar;)*)?
                $(self.$field.clone_from(&from.$field);)*
            }
        }

        impl $name {
            /// Zeroed arrays sized for `m`.
            pub fn new(m: &crate::arrays::Arrays) -> Self {
                let mut s = Self::default();
                s.clear(m);
                s
            }

            /// Zeroes everything, sized for `m`; memory is reused.
            pub fn clear(&mut self, m: &crate::arrays::Arrays) {
                $($(self.$scalar = Default::default();)*)?
                $(crate::table::Field::allocate(&mut self.$field, crate::table::field_rows!(m, $shape),
                    crate::table::field_width!(m, $shape));)*
            }

            /// True when every array is as long as the same array of `other`.
            pub fn same_lengths(&self, other: &Self) -> bool {
                $(self.$field.len() == other.$field.len())&&*
            }

            /// Bytes of the arrays sized for `m`.
            pub(crate) fn bytes(m: &crate::arrays::Arrays) -> usize {
                let mut sum: usize = 0;
                $(sum = sum.saturating_add(crate::table::field_rows!(m, $shape)
                    .saturating_mul(crate::table::field_width!(m, $shape))
                    .saturating_mul(<crate::table::field_type!($t, $shape) as crate::table::Field>::ROW_BYTES));)*
                sum
            }

            /// Calls `f(name, shape, values)` for every array, in declaration order.
            pub fn visit(&self, m: &crate::arrays::Arrays, f: &mut dyn FnMut(&'static str, Vec<usize>, crate::table::Slice<'_>)) {
                $(f(stringify!($field), crate::table::field_shape!(m, $shape), crate::table::Field::scalars(&self.$field));)*
            }

            /// The array that [`Self::visit`] calls at `number`, counted from 0.
            pub fn array(&self, number: usize) -> Option<crate::table::Slice<'_>> {
                type Read = for<'a> fn(&'a $name) -> crate::table::Slice<'a>;
                const READ: &[Read] = &[$(|s| crate::table::Row::scalars(&s.$field),)*];
                READ.get(number).map(|read| read(self))
            }

            /// The same to write.
            pub fn array_mut(&mut self, number: usize) -> Option<crate::table::SliceMut<'_>> {
                type Write = for<'a> fn(&'a mut $name) -> crate::table::SliceMut<'a>;
                const WRITE: &[Write] = &[$(|s| crate::table::Row::scalars_mut(&mut s.$field),)*];
                WRITE.get(number).map(|write| write(self))
            }

            /// Overwrites the array called `name`; `None` when there is none, `Some(false)` on a size mismatch.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $(stringify!($field) => Some(
                        crate::table::Field::scalars(&self.$field).len() == values.len()
                            && crate::table::Field::assign(&mut self.$field, values)),)*
                    _ => None,
                }
            }
        }
    };
}

pub(super) use stage;
