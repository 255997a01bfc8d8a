//! The control table that servos of the X series, and MX servos with protocol 2.0, have in common.

use Access::{Locked, Read, Write};

/// Who may write a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Nobody but the servo.
    Read,
    /// Anyone.
    Write,
    /// Anyone while torque is off; the value outlives a reboot (EEPROM area).
    Locked,
}

/// An entry of the control table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Register {
    /// Name in the e-Manual.
    pub name: &'static str,
    /// First byte.
    pub address: u16,
    /// Bytes: 1, 2 or 4; negative numbers as two's complement.
    pub size: u16,
    /// Who may write it.
    pub access: Access,
    /// Value after a factory reset.
    pub initial: i64,
    /// Smallest and largest value that it takes.
    pub range: [i64; 2],
}

/// Addresses of registers that drivers use.
pub mod address {
    #![allow(missing_docs)]
    pub const MODEL_NUMBER: u16 = 0;
    pub const FIRMWARE: u16 = 6;
    pub const ID: u16 = 7;
    pub const BAUD_RATE: u16 = 8;
    pub const RETURN_DELAY: u16 = 9;
    pub const OPERATING_MODE: u16 = 11;
    pub const HOMING_OFFSET: u16 = 20;
    pub const TEMPERATURE_LIMIT: u16 = 31;
    pub const CURRENT_LIMIT: u16 = 38;
    pub const VELOCITY_LIMIT: u16 = 44;
    pub const MAX_POSITION: u16 = 48;
    pub const MIN_POSITION: u16 = 52;
    pub const SHUTDOWN: u16 = 63;
    pub const TORQUE_ENABLE: u16 = 64;
    pub const STATUS_RETURN: u16 = 68;
    pub const REGISTERED: u16 = 69;
    pub const HARDWARE_ERROR: u16 = 70;
    pub const BUS_WATCHDOG: u16 = 98;
    pub const GOAL_PWM: u16 = 100;
    pub const GOAL_CURRENT: u16 = 102;
    pub const GOAL_VELOCITY: u16 = 104;
    pub const PROFILE_ACCELERATION: u16 = 108;
    pub const PROFILE_VELOCITY: u16 = 112;
    pub const GOAL_POSITION: u16 = 116;
    pub const REALTIME_TICK: u16 = 120;
    pub const MOVING: u16 = 122;
    pub const PRESENT_PWM: u16 = 124;
    pub const PRESENT_CURRENT: u16 = 126;
    pub const PRESENT_VELOCITY: u16 = 128;
    pub const PRESENT_POSITION: u16 = 132;
    pub const PRESENT_VOLTAGE: u16 = 144;
    pub const PRESENT_TEMPERATURE: u16 = 146;
    pub const INDIRECT_ADDRESS: u16 = 168;
    pub const INDIRECT_DATA: u16 = 224;
    /// Bytes of the table.
    pub const END: u16 = 252;
}

/// One row of the table.
const fn row(
    name: &'static str,
    address: u16,
    size: u16,
    access: Access,
    initial: i64,
    range: [i64; 2],
) -> Register {
    Register { name, address, size, access, initial, range }
}

/// Largest and smallest of 32 bits, for registers whose range is given by a limit register.
const ANY: [i64; 2] = [i32::MIN as i64, i32::MAX as i64];
const BYTE: [i64; 2] = [0, 255];
const GAIN: [i64; 2] = [0, 16_383];

/// The table of an XM430-W350; what other models have otherwise stands in [`super::Model`].
pub(super) const TABLE: [Register; 50] = [
    row("Model Number", address::MODEL_NUMBER, 2, Read, 0, ANY),
    row("Model Information", 2, 4, Read, 0, ANY),
    row("Firmware Version", address::FIRMWARE, 1, Read, 48, BYTE),
    row("ID", address::ID, 1, Locked, 1, [0, 252]),
    row("Baud Rate", address::BAUD_RATE, 1, Locked, 1, [0, 7]),
    row("Return Delay Time", address::RETURN_DELAY, 1, Locked, 250, [0, 254]),
    row("Drive Mode", 10, 1, Locked, 0, [0, 13]),
    row("Operating Mode", address::OPERATING_MODE, 1, Locked, 3, [0, 16]),
    row("Secondary ID", 12, 1, Locked, 255, BYTE),
    row("Protocol Type", 13, 1, Locked, 2, [2, 2]),
    row("Homing Offset", address::HOMING_OFFSET, 4, Locked, 0, [-1_044_479, 1_044_479]),
    row("Moving Threshold", 24, 4, Locked, 10, [0, 1023]),
    row("Temperature Limit", address::TEMPERATURE_LIMIT, 1, Locked, 80, [0, 100]),
    row("Max Voltage Limit", 32, 2, Locked, 160, [0, 160]),
    row("Min Voltage Limit", 34, 2, Locked, 95, [0, 160]),
    row("PWM Limit", 36, 2, Locked, 885, [0, 885]),
    row("Current Limit", address::CURRENT_LIMIT, 2, Locked, 1193, [0, 2047]),
    row("Velocity Limit", address::VELOCITY_LIMIT, 4, Locked, 350, [0, 2047]),
    row("Max Position Limit", address::MAX_POSITION, 4, Locked, 4095, [0, 4095]),
    row("Min Position Limit", address::MIN_POSITION, 4, Locked, 0, [0, 4095]),
    row("Startup Configuration", 60, 1, Locked, 0, BYTE),
    row("Shutdown", address::SHUTDOWN, 1, Locked, 52, BYTE),
    row("Torque Enable", address::TORQUE_ENABLE, 1, Write, 0, [0, 1]),
    row("LED", 65, 1, Write, 0, [0, 1]),
    row("Status Return Level", address::STATUS_RETURN, 1, Write, 2, [0, 2]),
    row("Registered Instruction", address::REGISTERED, 1, Read, 0, BYTE),
    row("Hardware Error Status", address::HARDWARE_ERROR, 1, Read, 0, BYTE),
    row("Velocity I Gain", 76, 2, Write, 1920, GAIN),
    row("Velocity P Gain", 78, 2, Write, 100, GAIN),
    row("Position D Gain", 80, 2, Write, 0, GAIN),
    row("Position I Gain", 82, 2, Write, 0, GAIN),
    row("Position P Gain", 84, 2, Write, 800, GAIN),
    row("Feedforward 2nd Gain", 88, 2, Write, 0, GAIN),
    row("Feedforward 1st Gain", 90, 2, Write, 0, GAIN),
    // Reads -1 once it has tripped; only 0 clears it.
    row("Bus Watchdog", address::BUS_WATCHDOG, 1, Write, 0, [0, 127]),
    row("Goal PWM", address::GOAL_PWM, 2, Write, 0, ANY),
    row("Goal Current", address::GOAL_CURRENT, 2, Write, 0, ANY),
    row("Goal Velocity", address::GOAL_VELOCITY, 4, Write, 0, ANY),
    row("Profile Acceleration", address::PROFILE_ACCELERATION, 4, Write, 0, [0, 32_767]),
    row("Profile Velocity", address::PROFILE_VELOCITY, 4, Write, 0, [0, 32_767]),
    row("Goal Position", address::GOAL_POSITION, 4, Write, 0, ANY),
    row("Realtime Tick", address::REALTIME_TICK, 2, Read, 0, ANY),
    row("Moving", address::MOVING, 1, Read, 0, BYTE),
    row("Moving Status", 123, 1, Read, 0, BYTE),
    row("Present PWM", address::PRESENT_PWM, 2, Read, 0, ANY),
    row("Present Current", address::PRESENT_CURRENT, 2, Read, 0, ANY),
    row("Present Velocity", address::PRESENT_VELOCITY, 4, Read, 0, ANY),
    row("Present Position", address::PRESENT_POSITION, 4, Read, 0, ANY),
    row("Present Input Voltage", address::PRESENT_VOLTAGE, 2, Read, 120, ANY),
    row("Present Temperature", address::PRESENT_TEMPERATURE, 1, Read, 30, BYTE),
];
