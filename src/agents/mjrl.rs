//! Policies that mjrl trained and pickled: Gaussian, their mean a network of PyTorch layers with tanh between them.

use crate::error::PolicyError;
use crate::network::{Layer, Network, Transformation};
use dataset::pickle::{Pickle, Value};

/// Reads the network that computes the mean action.
///
/// # Errors
/// The bytes are no pickle, or one of something else.
pub(crate) fn read(bytes: &[u8]) -> Result<Network, PolicyError> {
    let pickle = Pickle::parse(bytes)?;
    let policy = pickle.root();
    match policy.callable() {
        Some((module, "MLP")) if module.ends_with("policies.gaussian_mlp") => {}
        _ => {
            let kind = policy.kind();
            return Err(PolicyError::content(format!(
                "{kind} is not understood; policies of mjrl's gaussian_mlp.MLP are"
            )));
        }
    }
    let inputs = count(policy, "n")?;
    let outputs = count(policy, "m")?;
    let model = member(policy, "model")?;
    let function = member(model, "nonlinearity")?;
    if function.call("builtins", "getattr").and_then(|name| name.item(1)?.text()) != Some("tanh") {
        return Err(PolicyError::content("its layers are not joined by tanh, which alone is understood"));
    }
    let modules = member(member(model, "_modules")?.get("fc_layers").unwrap_or(model), "_modules")?;
    let layers = modules.entries().map(|(_, linear)| layer(linear)).collect::<Result<Vec<_>, _>>()?;
    let scales = member(model, "transformations")?;
    let before = Transformation { shift: vector(scales, "in_shift")?, scale: vector(scales, "in_scale")? };
    let after = Transformation { shift: vector(scales, "out_shift")?, scale: vector(scales, "out_scale")? };
    let network = Network::new(inputs, layers, before, after)?;
    if network.outputs() == outputs {
        return Ok(network);
    }
    let found = network.outputs();
    Err(PolicyError::content(format!("it has {found} outputs for actions of {outputs} values")))
}

fn member<'p>(object: Value<'p>, name: &str) -> Result<Value<'p>, PolicyError> {
    object.member(name).ok_or_else(|| PolicyError::content(format!("{} has no {name}", object.kind())))
}

fn count(object: Value<'_>, name: &str) -> Result<usize, PolicyError> {
    let value = member(object, name)?;
    value.count().ok_or_else(|| PolicyError::content(format!("{name} is {}, no count", value.kind())))
}

fn layer(linear: Value<'_>) -> Result<Layer, PolicyError> {
    let parameters = member(linear, "_parameters")?;
    let numbers = |name: &str| {
        let tensor = parameters.get(name);
        let tensor = tensor.ok_or_else(|| PolicyError::content(format!("a layer has no {name}")))?;
        Ok::<_, PolicyError>(tensor.tensor()?.values.to_f64())
    };
    Ok(Layer { weight: numbers("weight")?, bias: numbers("bias")? })
}

/// A vector of numbers; `None` where it is absent or nothing.
fn vector(scales: Value<'_>, name: &str) -> Result<Option<Vec<f64>>, PolicyError> {
    match scales.get(name) {
        Some(value) if !value.is_none() => Ok(Some(value.array()?.values.to_f64())),
        _ => Ok(None),
    }
}
