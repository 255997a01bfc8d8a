//! Attributes of elements by name: what bindings to other languages show and write, from the declarations of the elements.
//!
//! Names are the same as in MuJoCo's `mjSpec`; enumerations are their integers, an absent number is NaN. What is not a plain
//! value (orientations, inertias, paths, what a body holds) is a field of its own type and not listed.
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_mjcf::spec::{Fields, Geom, Value};
//!
//! let mut geom = Geom::default();
//! assert_eq!(geom.assign("type", Value::Integer(6)), Some(true));
//! assert_eq!(geom.assign("size", Value::Reals(vec![0.1])), Some(false));
//! assert_eq!(geom.assign("colour", Value::Integer(0)), None);
//! assert_eq!(geom.kind, robohive_physics::model::GeomType::Box);
//! ```

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Yes or no.
    Flag(bool),
    /// A whole number, or the code of an enumeration.
    Integer(i64),
    /// A number.
    Real(f64),
    /// Whole numbers.
    Integers(Vec<i32>),
    /// Numbers of single precision.
    Singles(Vec<f32>),
    /// Numbers of double precision.
    Reals(Vec<f64>),
    /// Letters, one byte each.
    Letters(Vec<u8>),
    /// A text.
    Text(String),
    /// Texts.
    Texts(Vec<String>),
}

/// What values an attribute takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// [`Value::Flag`].
    Flag,
    /// [`Value::Integer`].
    Integer,
    /// [`Value::Integer`] with the codes of MuJoCo's enumeration of this name.
    Code(&'static str),
    /// [`Value::Real`].
    Real,
    /// [`Value::Integers`], of a fixed number unless it is `None`.
    Integers(Option<usize>),
    /// [`Value::Singles`], of a fixed number unless it is `None`.
    Singles(Option<usize>),
    /// [`Value::Reals`], of a fixed number unless it is `None`.
    Reals(Option<usize>),
    /// [`Value::Letters`], of a fixed number unless it is `None`.
    Letters(Option<usize>),
    /// [`Value::Text`].
    Text,
    /// [`Value::Texts`], of a fixed number unless it is `None`.
    Texts(Option<usize>),
}

/// An element or a group of settings whose attributes are found by name.
pub trait Fields {
    /// Calls `visit` with name, form and value of every attribute, in order of declaration.
    fn visit(&self, visit: &mut dyn FnMut(&'static str, Form, Value));

    /// Overwrites the attribute called `name`: `None` when there is none, `Some(false)` when the value does not fit it.
    fn assign(&mut self, name: &str, value: Value) -> Option<bool>;
}

/// A type that attributes have.
pub(crate) trait Field {
    /// What values it takes; `None` for what is no plain value.
    const FORM: Option<Form> = None;

    /// The value.
    fn value(&self) -> Value {
        Value::Flag(false)
    }

    /// Takes a value; `false` when it does not fit.
    fn accept(&mut self, _value: Value) -> bool {
        false
    }
}

/// The name of a field outside: what is a word of Rust has another name inside.
pub(crate) fn outer_name(field: &'static str) -> &'static str {
    match field {
        "kind" => "type",
        "ref_" => "ref",
        "shellinertia" => "typeinertia",
        name => name,
    }
}

/// Makes the plain fields of a type visible by name.
macro_rules! fields {
    ($name:ident: $($field:ident)*) => {
        impl $crate::spec::field::Fields for $name {
            fn visit(
                &self,
                visit: &mut dyn FnMut(&'static str, $crate::spec::field::Form, $crate::spec::field::Value),
            ) {
                use $crate::spec::field::{Field, form_of, outer_name};
                $(if let Some(form) = form_of(&self.$field) {
                    visit(outer_name(stringify!($field)), form, Field::value(&self.$field));
                })*
            }

            fn assign(&mut self, name: &str, value: $crate::spec::field::Value) -> Option<bool> {
                use $crate::spec::field::{Field, form_of, outer_name};
                $(if name == outer_name(stringify!($field)) && form_of(&self.$field).is_some() {
                    return Some(Field::accept(&mut self.$field, value));
                })*
                None
            }
        }
    };
}
pub(crate) use fields;

/// The form of the type of `_value`.
pub(crate) fn form_of<T: Field>(_value: &T) -> Option<Form> {
    T::FORM
}

/// Types with one kind of value: form, how it is shown, and how it is taken.
macro_rules! plain {
    ($($t:ty: $form:expr, |$own:ident| $show:expr, |$slot:ident| $($pattern:pat => $take:expr),+;)*) => {
        $(impl Field for $t {
            const FORM: Option<Form> = Some($form);

            fn value(&self) -> Value {
                let $own = self;
                $show
            }

            fn accept(&mut self, value: Value) -> bool {
                let $slot = self;
                match value {
                    $($pattern => $take,)+
                    _ => false,
                }
            }
        })*
    };
}

/// Writes into a slot.
pub(super) fn put<T>(slot: &mut T, value: T) -> bool {
    *slot = value;
    true
}

/// Writes a number that may not fit the slot's type.
fn put_if<T>(slot: &mut T, value: Result<T, impl Sized>) -> bool {
    value.map(|value| *slot = value).is_ok()
}

plain! {
    bool: Form::Flag, |own| Value::Flag(*own),
        |slot| Value::Flag(x) => put(slot, x), Value::Integer(x) => put(slot, x != 0);
    i32: Form::Integer, |own| Value::Integer(i64::from(*own)),
        |slot| Value::Integer(x) => put_if(slot, i32::try_from(x)), Value::Flag(x) => put(slot, i32::from(x));
    f64: Form::Real, |own| Value::Real(*own),
        |slot| Value::Real(x) => put(slot, x), Value::Integer(x) => put(slot, x as f64);
    f32: Form::Real, |own| Value::Real(f64::from(*own)),
        |slot| Value::Real(x) => put(slot, x as f32), Value::Integer(x) => put(slot, x as f32);
    String: Form::Text, |own| Value::Text(own.clone()), |slot| Value::Text(x) => put(slot, x);
    Vec<i32>: Form::Integers(None), |own| Value::Integers(own.clone()), |slot| Value::Integers(x) => put(slot, x);
    Vec<f32>: Form::Singles(None), |own| Value::Singles(own.clone()), |slot| Value::Singles(x) => put(slot, x);
    Vec<f64>: Form::Reals(None), |own| Value::Reals(own.clone()), |slot| Value::Reals(x) => put(slot, x);
    Vec<String>: Form::Texts(None), |own| Value::Texts(own.clone()), |slot| Value::Texts(x) => put(slot, x);
    Vec<u8>: Form::Letters(None), |own| Value::Letters(own.clone()), |slot| Value::Letters(x) => put(slot, x);
    Option<f64>: Form::Real, |own| Value::Real(own.unwrap_or(f64::NAN)),
        |slot| Value::Real(x) => put(slot, (!x.is_nan()).then_some(x)),
        Value::Integer(x) => put(slot, Some(x as f64));
    Option<i32>: Form::Integer, |own| Value::Integer(own.map_or(-1, i64::from)),
        |slot| Value::Integer(-1) => put(slot, None),
        Value::Integer(x) => i32::try_from(x).is_ok_and(|x| put(slot, Some(x)));
    Option<i64>: Form::Integer, |own| Value::Integer(own.unwrap_or(-1)),
        |slot| Value::Integer(x) => put(slot, (x != -1).then_some(x));
}

/// Arrays of a fixed number.
macro_rules! arrays {
    ($($t:ty: $form:ident;)*) => {
        $(impl<const N: usize> Field for [$t; N] {
            const FORM: Option<Form> = Some(Form::$form(Some(N)));

            fn value(&self) -> Value {
                Value::$form(self.to_vec())
            }

            fn accept(&mut self, value: Value) -> bool {
                match value {
                    Value::$form(values) => put_if(self, values.try_into()),
                    _ => false,
                }
            }
        })*
    };
}

arrays! {
    i32: Integers;
    f32: Singles;
    f64: Reals;
    u8: Letters;
}

impl<const N: usize> Field for [String; N] {
    const FORM: Option<Form> = Some(Form::Texts(Some(N)));

    fn value(&self) -> Value {
        Value::Texts(self.to_vec())
    }

    fn accept(&mut self, value: Value) -> bool {
        match value {
            Value::Texts(texts) => put_if(self, texts.try_into()),
            _ => false,
        }
    }
}

/// An array that begins with NaN where it is absent.
impl<const N: usize> Field for Option<[f64; N]> {
    const FORM: Option<Form> = Some(Form::Reals(Some(N)));

    fn value(&self) -> Value {
        let mut absent = [0.0; N];
        if let Some(first) = absent.first_mut() {
            *first = f64::NAN;
        }
        self.unwrap_or(absent).value()
    }

    fn accept(&mut self, value: Value) -> bool {
        let mut numbers = [0.0_f64; N];
        let fits = numbers.accept(value);
        if fits {
            *self = numbers.first().is_some_and(|x| !x.is_nan()).then_some(numbers);
        }
        fits
    }
}
