//! A policy of mjrl, pickled by hand, in an environment of our own.

use env::{Env, Options, OwnModels};
use robohive_agents::{Policy, PolicyError};

const ID: &str = "hive/FrankaReach-v0";
const HIDDEN: usize = 3;

/// Opcodes that leave one value.
type Code = Vec<u8>;

fn int(value: usize) -> Code {
    [b"J", &(value as i32).to_le_bytes()[..]].concat()
}

fn text(value: &str) -> Code {
    [b"X", &(value.len() as u32).to_le_bytes()[..], value.as_bytes()].concat()
}

fn bytes(value: &[u8]) -> Code {
    [b"B", &(value.len() as u32).to_le_bytes()[..], value].concat()
}

fn name(module: &str, name: &str) -> Code {
    format!("c{module}\n{name}\n").into_bytes()
}

fn tuple(items: &[Code]) -> Code {
    [b"(", &items.concat()[..], b"t"].concat()
}

fn call(callable: Code, arguments: &[Code]) -> Code {
    [callable, tuple(arguments), b"R".to_vec()].concat()
}

/// Sets entries in the value before.
fn set(entries: &[(&str, Code)]) -> Code {
    let entries: Vec<Code> = entries.iter().map(|(key, value)| [text(key), value.clone()].concat()).collect();
    [b"(", &entries.concat()[..], b"u"].concat()
}

fn dict(entries: &[(&str, Code)]) -> Code {
    [b"}".to_vec(), set(entries)].concat()
}

fn ordered(entries: &[(&str, Code)]) -> Code {
    [call(name("collections", "OrderedDict"), &[]), set(entries)].concat()
}

fn object(class: Code, state: &[(&str, Code)]) -> Code {
    [class, b")\x81".to_vec(), dict(state), b"b".to_vec()].concat()
}

fn pickle(value: Code) -> Code {
    [b"\x80\x02".to_vec(), value, b".".to_vec()].concat()
}

/// A parameter of PyTorch whose storage holds `values` after two numbers that belong to another tensor.
fn parameter(shape: &[usize], values: &[f32]) -> Code {
    let magic = b"\x8a\x0a\x6c\xfc\x9c\x46\xf9\x20\x6a\xa8\x50\x19".to_vec();
    let reference =
        [text("storage"), name("torch", "FloatStorage"), text("7"), text("cpu"), int(values.len() + 2)];
    let mut stream = [
        pickle(magic),
        pickle(int(1001)),
        pickle(dict(&[("little_endian", b"\x88".to_vec())])),
        pickle([tuple(&reference), b"Q".to_vec()].concat()),
        pickle([b"](".to_vec(), text("7"), b"e".to_vec()].concat()),
        (values.len() as u64 + 2).to_le_bytes().to_vec(),
    ]
    .concat();
    stream.extend([[0xffu8; 4]; 2].as_flattened());
    stream.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    let lengths = |lengths: &[usize]| tuple(&lengths.iter().map(|&length| int(length)).collect::<Vec<_>>());
    let strides = if shape.len() == 2 { vec![shape[1], 1] } else { vec![1] };
    let storage = call(name("torch.storage", "_load_from_bytes"), &[bytes(&stream)]);
    let tensor = call(
        name("torch._utils", "_rebuild_tensor_v2"),
        &[storage, int(2), lengths(shape), lengths(&strides)],
    );
    call(name("torch._utils", "_rebuild_parameter"), &[tensor, b"\x88".to_vec()])
}

/// A vector of numpy.
fn vector(values: &[f64]) -> Code {
    let empty = [name("numpy", "ndarray"), tuple(&[int(0)]), bytes(b"b")];
    let kind = call(name("numpy", "dtype"), &[text("f8"), b"\x89".to_vec(), b"\x88".to_vec()]);
    let order = tuple(&[int(3), text("<")]);
    let numbers: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let state = tuple(&[
        int(1),
        tuple(&[int(values.len())]),
        [kind, order, b"b".to_vec()].concat(),
        b"\x89".to_vec(),
        bytes(&numbers),
    ]);
    [call(name("numpy.core.multiarray", "_reconstruct"), &empty), state, b"b".to_vec()].concat()
}

/// Weight of a layer from one place to another.
fn weight(row: usize, column: usize) -> f32 {
    ((3 * row + column) % 7) as f32 / 8.0 - 0.375
}

fn layer(outputs: usize, inputs: usize) -> Code {
    let weights: Vec<f32> =
        (0..outputs).flat_map(|row| (0..inputs).map(move |column| weight(row, column))).collect();
    let biases: Vec<f32> = (0..outputs).map(|row| row as f32 / 16.0).collect();
    let parameters =
        [("weight", parameter(&[outputs, inputs], &weights)), ("bias", parameter(&[outputs], &biases))];
    object(name("torch.nn.modules.linear", "Linear"), &[("_parameters", ordered(&parameters))])
}

/// A policy with one hidden layer, whose input is scaled.
fn policy(inputs: usize, outputs: usize, nonlinearity: &str) -> Code {
    let layers = ordered(&[("0", layer(HIDDEN, inputs)), ("1", layer(outputs, HIDDEN))]);
    let list = object(name("torch.nn.modules.container", "ModuleList"), &[("_modules", layers)]);
    let function = [name("torch._C", "_VariableFunctions"), text(nonlinearity)];
    let scales = [
        ("in_shift", vector(&vec![0.25; inputs])),
        ("in_scale", vector(&vec![2.0; inputs])),
        ("out_shift", b"N".to_vec()),
    ];
    let model = [
        ("_modules", ordered(&[("fc_layers", list)])),
        ("transformations", dict(&scales)),
        ("nonlinearity", call(name("builtins", "getattr"), &function)),
    ];
    let model = object(name("mjrl.utils.fc_network", "FCNetwork"), &model);
    let members = [("n", int(inputs)), ("m", int(outputs)), ("model", model)];
    pickle(object(name("mjrl.policies.gaussian_mlp", "MLP"), &members))
}

fn make() -> Env {
    let mut env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    env.reset(Some(3)).unwrap();
    env
}

#[test]
fn the_mean_action_follows_from_the_observation() {
    let mut env = make();
    let (inputs, outputs) = (env.observation().len(), env.action_len());
    let mut policy = Policy::parse(&policy(inputs, outputs, "tanh")).unwrap();
    let mut action = vec![0.0; outputs];
    for _ in 0..3 {
        policy.action(&env, &mut action).unwrap();
        let seen: Vec<f64> = env.observation().iter().map(|x| (x - 0.25) / (2.0 + 1e-8)).collect();
        let affine = |row: usize, x: &[f64]| {
            x.iter().enumerate().map(|(k, x)| f64::from(weight(row, k)) * x).sum::<f64>() + row as f64 / 16.0
        };
        let hidden: Vec<f64> = (0..HIDDEN).map(|row| affine(row, &seen).tanh()).collect();
        for (row, &given) in action.iter().enumerate() {
            assert!((given - affine(row, &hidden)).abs() < 1e-13, "{row}: {given}");
        }
        assert!(action.iter().any(|value| value.abs() > 0.1));
        env.step(&action).unwrap();
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let env = make();
    let (inputs, outputs) = (env.observation().len(), env.action_len());
    let mut action = vec![0.0; outputs];
    let mut refusal = |inputs, outputs| {
        let mut policy = Policy::parse(&policy(inputs, outputs, "tanh")).unwrap();
        policy.action(&env, &mut action).unwrap_err().to_string()
    };
    let message = refusal(inputs + 1, outputs);
    assert!(
        message.contains(ID) && message.contains(&format!("takes {} observed values", inputs + 1)),
        "{message}"
    );
    let message = refusal(inputs, outputs + 2);
    assert!(message.contains(&format!("gives actions of {} values", outputs + 2)), "{message}");
    let message = |bytes: &[u8]| match Policy::parse(bytes) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("this is no policy"),
    };
    assert!(message(&policy(inputs, outputs, "relu")).contains("not joined by tanh"));
    assert!(message(&pickle(text("policy"))).contains("a text is not understood"));
    assert!(message(b"GIF89a").contains("byte 0 of the pickle"));
    let Err(PolicyError::File { path, .. }) = Policy::open("no/such/file") else {
        panic!("there is no file")
    };
    assert_eq!(path.to_str(), Some("no/such/file"));
}

/// A file without end is read up to the limit.
#[cfg(unix)]
#[test]
fn a_file_that_is_too_long_is_refused() {
    let Err(error) = Policy::open("/dev/zero") else { panic!("zeros are no policy") };
    assert_eq!(
        error.to_string(),
        "the policy /dev/zero: it has more than 64 MiB, and no file of its kind has"
    );
}

#[test]
fn a_damaged_policy_is_an_error_and_never_a_panic() {
    let whole = policy(4, 2, "tanh");
    assert!(Policy::parse(&whole).is_ok());
    for end in 0..whole.len() {
        assert!(Policy::parse(&whole[..end]).is_err());
    }
    let mut refused = 0;
    for place in 0..whole.len() {
        let mut changed = whole.clone();
        changed[place] ^= 0x11;
        refused += usize::from(Policy::parse(&changed).is_err());
    }
    assert!(refused > whole.len() / 2, "{refused} of {} changes are noticed", whole.len());
}

#[test]
fn random_actions_follow_from_their_seed() {
    let env = make();
    let draw = |seed| {
        let (mut policy, mut action) = (Policy::random(seed), vec![0.0; env.action_len()]);
        policy.action(&env, &mut action).unwrap();
        action
    };
    assert_eq!(draw(1), draw(1));
    assert_ne!(draw(1), draw(2));
    assert!(draw(1).iter().all(|value| (-1.0..=1.0).contains(value)));
    let mut zero = vec![1.0; env.action_len()];
    Policy::Zero.action(&env, &mut zero).unwrap();
    assert!(zero.iter().all(|&value| value == 0.0));
}
