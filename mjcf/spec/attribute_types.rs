//! Types of attributes beside numbers and texts: enumerations, and what is no plain value.

use physics::model::{
    BiasType, ColorSpace, DataType, DynType, EqType, FlexSelf, GainType, GeomType, JointType,
    LengthRangeMode, LightType, ObjType, Projection, SensorType, SleepPolicy, Stage, TextureType, TrackMode,
    TrnType,
};

use super::constraint::Wrap;
use super::custom::{Keyed, TupleEntry};
use super::element::Limited;
use super::field::{Field, Form, Value, put};
use super::flex::Elastic2d;
use super::orientation::Orientation;
use super::plugin::PluginUse;
use super::settings::{Conflict, InertiaFromGeom};
use super::tree::{AlignFree, Body, Camera, Geom, Inertial, Joint, Light, Site};
use crate::diagnostic::Loc;
use crate::image::{Builtin, Mark};
use crate::mesh::{Bone, MeshInertia, Shape};

/// Enumerations of the model, which know their codes.
macro_rules! codes {
    ($($t:ident: $name:literal;)*) => {
        $(impl Field for $t {
            const FORM: Option<Form> = Some(Form::Code($name));

            fn value(&self) -> Value {
                Value::Integer(i64::from(self.code()))
            }

            fn accept(&mut self, value: Value) -> bool {
                let Value::Integer(code) = value else { return false };
                let found = i32::try_from(code).ok().and_then($t::from_code);
                found.is_some_and(|found| put(self, found))
            }
        })*
    };
}

codes! {
    JointType: "mjtJoint";
    GeomType: "mjtGeom";
    TrackMode: "mjtCamLight";
    LightType: "mjtLightType";
    TextureType: "mjtTexture";
    ColorSpace: "mjtColorSpace";
    Projection: "mjtProjection";
    SleepPolicy: "mjtSleepPolicy";
    EqType: "mjtEq";
    ObjType: "mjtObj";
    GainType: "mjtGain";
    BiasType: "mjtBias";
    DynType: "mjtDyn";
    TrnType: "mjtTrn";
    SensorType: "mjtSensor";
    DataType: "mjtDataType";
    Stage: "mjtStage";
    LengthRangeMode: "mjtLRMode";
    FlexSelf: "mjtFlexSelf";
}

/// Enumerations of the description, whose codes count from 0.
macro_rules! counted {
    ($($t:ident: $name:literal, $($variant:ident)*;)*) => {
        $(impl Field for $t {
            const FORM: Option<Form> = Some(Form::Code($name));

            fn value(&self) -> Value {
                let all = [$($t::$variant),*];
                Value::Integer(all.iter().position(|other| other == self).unwrap_or(0) as i64)
            }

            fn accept(&mut self, value: Value) -> bool {
                let Value::Integer(code) = value else { return false };
                let all = [$($t::$variant),*];
                let found = usize::try_from(code).ok().and_then(|code| all.get(code).copied());
                found.is_some_and(|found| put(self, found))
            }
        })*
    };
}

counted! {
    Limited: "mjtLimited", False True Auto;
    AlignFree: "mjtAlignFree", False True Auto;
    InertiaFromGeom: "mjtInertiaFromGeom", False True Auto;
    Conflict: "mjtConflict", Warning Merge Error;
    MeshInertia: "mjtMeshInertia", Convex Exact Legacy Shell;
    Builtin: "mjtBuiltin", None Gradient Checker Flat;
    Mark: "mjtMark", None Edge Cross Random;
    Elastic2d: "mjtElastic2d", None Bend Stretch Both;
}

/// The shape of a computed mesh; 0 is none.
impl Field for Option<Shape> {
    const FORM: Option<Form> = Some(Form::Code("mjtMeshBuiltin"));

    fn value(&self) -> Value {
        let code = self.and_then(|own| SHAPES.iter().position(|shape| *shape == own).map(|at| at + 1));
        Value::Integer(code.unwrap_or(0) as i64)
    }

    fn accept(&mut self, value: Value) -> bool {
        match value {
            Value::Integer(0) => put(self, None),
            Value::Integer(code) => {
                let found = usize::try_from(code - 1).ok().and_then(|at| SHAPES.get(at));
                found.is_some_and(|shape| put(self, Some(*shape)))
            }
            _ => false,
        }
    }
}

const SHAPES: [Shape; 7] = [
    Shape::Sphere,
    Shape::Hemisphere,
    Shape::Cone,
    Shape::Supersphere,
    Shape::Supertorus,
    Shape::Wedge,
    Shape::Plate,
];

/// What is no plain value.
macro_rules! held {
    ($($t:ty)*) => { $(impl Field for $t {})* };
}

held! {
    Option<usize> Option<Orientation> Option<Inertial> Option<PluginUse> Vec<(String, String)> Vec<bool>
    Vec<Keyed> Vec<Wrap> Vec<TupleEntry> Vec<Bone>
    Vec<Joint> Vec<Geom> Vec<Site> Vec<Camera> Vec<Light> Vec<Body>
    Loc
}
