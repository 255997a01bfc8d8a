//! How long a reading of all servos on a bus takes, on the bench's own clock: by sync read, by fast sync read, one by one.
//!
//! `cargo run --profile ci -p robohive-hardware --example bus_time`. Nothing here depends on the machine.

use robohive_hardware::{Services, Setup, device};
use robot::Config;
use std::error::Error;
use std::sync::{Arc, Mutex};
use wire::{Bench, Plant, VirtualClock, VirtualPort};

/// Readings of which the mean is taken.
const READINGS: u32 = 100;

fn bench(servos: u8) -> Result<Bench, Box<dyn Error>> {
    let wheel = |id| {
        format!(
            "<body pos='{id} 0 0'><joint name='{id}' axis='0 1 0' damping='.05' armature='.01'/><geom size='.05' mass='.1'/></body>"
        )
    };
    let motor = |id| format!("<position name='{id}' joint='{id}' kp='10' kv='.5'/>");
    let text = format!(
        "<mujoco><option gravity='0 0 0'/><worldbody>{}</worldbody><actuator>{}</actuator></mujoco>",
        (1..=servos).map(wheel).collect::<String>(),
        (1..=servos).map(motor).collect::<String>()
    );
    Ok(Bench::new(Plant::new(robohive_mjcf::load_str(&text)?.model)?))
}

fn config(servos: u8, baud: u32, interface: &str) -> Result<Config, Box<dyn Error>> {
    let ids = || 1..=servos;
    let sensor = |id| format!("{{ name = '{id}', range = [-9, 9], hdr_id = {id} }},");
    let actuator = |id| {
        format!("{{ name = '{id}', pos_range = [-1, 1], vel_range = [-9, 9], hdr_id = {id}, offset = 2.6 }},")
    };
    let text = format!(
        "[[device]]\nname = 'servos'\ninterface = {{ name = 'bus', baud = {baud}, {interface} }}\nsensor = [{}]\nactuator = [{}]",
        ids().map(sensor).collect::<String>(),
        ids().map(actuator).collect::<String>()
    );
    Ok(Config::from_toml(&text, "servos.toml")?)
}

/// Mean time of a reading \[ms\], after the servos were armed, which sets their return delay to 0.
fn time(servos: u8, baud: u32, interface: &str) -> Result<f64, Box<dyn Error>> {
    let config = config(servos, baud, interface)?;
    let mut bench = bench(servos)?;
    let link = wire::connect(&config.devices[0], &mut bench, false)?[0].1;
    let bench = Arc::new(Mutex::new(bench));
    let (clocked, opened) = (bench.clone(), bench.clone());
    let setup = Setup::default()
        .in_virtual_time(
            Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _),
            Services::default(),
            Arc::new(move |_: &str, _| Ok(Box::new(VirtualPort::new(opened.clone(), link)) as _)),
        )
        .with_armed(true);
    let mut device = device(&config.devices[0], &setup)?;
    device.connect()?;
    device.reset(&vec![2.6; usize::from(servos)])?;
    let now = || bench.lock().map_or(f64::NAN, |bench| bench.time());
    let begun = now();
    for _ in 0..READINGS {
        device.read(&mut vec![0.0; usize::from(servos)])?;
    }
    let mean = (now() - begun) / f64::from(READINGS);
    device.close()?;
    Ok(mean * 1e3)
}

fn main() -> Result<(), Box<dyn Error>> {
    const WAYS: [(&str, &str); 4] = [
        ("XM430-W350, sync read", "type = 'dynamixel', fast_sync_read = false"),
        ("XM430-W350, fast sync read", "type = 'dynamixel'"),
        ("AX-12A (protocol 1.0), one by one", "type = 'dynamixel', protocol = 1"),
        ("STS3215 (Feetech), sync read", "type = 'feetech'"),
    ];
    println!("| servos | baud | a reading of 6 [ms] | of 12 [ms] | of 24 [ms] |\n|---|---|---|---|---|");
    for (name, interface) in WAYS {
        for baud in [1_000_000, 4_000_000] {
            // Only protocol 2.0 is that fast.
            if baud > 1_000_000 && !name.starts_with("XM") {
                continue;
            }
            let times: Vec<_> = [6, 12, 24]
                .into_iter()
                .map(|servos| time(servos, baud, interface).map(|time| format!("{time:.3}")))
                .collect::<Result<_, _>>()?;
            println!("| {name} | {} Mbit/s | {} |", baud / 1_000_000, times.join(" | "));
        }
    }
    Ok(())
}
