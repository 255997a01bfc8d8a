//! What a driver does.

use crate::safety::limits::Limits;
use crate::safety::watchdog::Timeouts;
use robot::Fault;

/// Speaks a device's protocol. What makes a device safe to use, see [`Guarded`](crate::Guarded), stands around it.
///
/// Sensors and actuators are those of one device of a config, in its order; values are in the hardware's units, which the
/// driver's page states. Calls block for as long as the device takes to answer, a few milliseconds.
pub trait Driver: Send {
    /// Opens the connection and makes sure that the devices of the config are there. Nothing moves.
    ///
    /// # Errors
    /// Devices that are not there, or are not what the config says: what to do about it.
    fn connect(&mut self) -> Result<(), Fault>;

    /// Reads the newest value of every sensor.
    ///
    /// # Errors
    /// No answer, or one that says that the hardware has failed.
    fn read(&mut self, values: &mut [f64]) -> Result<(), Fault>;

    /// Reads what every actuator would be commanded to stay as it is: a position where positions are commanded, 0 where
    /// velocities or torques are.
    ///
    /// # Errors
    /// As [`Driver::read`].
    fn present(&mut self, commands: &mut [f64]) -> Result<(), Fault>;

    /// Lets the actuators act, beginning from `present`: what is commanded before they get torque.
    ///
    /// # Errors
    /// A device that refuses, and why.
    fn arm(&mut self, present: &[f64]) -> Result<(), Fault>;

    /// Refuses commands that are each within their limits but are not allowed in combination. Sends nothing to the device.
    ///
    /// # Errors
    /// The limit that the commands would exceed.
    fn check(&self, _commands: &[f64]) -> Result<(), Fault> {
        Ok(())
    }

    /// Commands every actuator.
    ///
    /// # Errors
    /// A device that cannot be reached or refuses.
    fn command(&mut self, commands: &[f64]) -> Result<(), Fault>;

    /// Begins to bring the device into its safe state; called again and again until it returns true. It does what it can
    /// when a part of the device does not answer.
    ///
    /// # Errors
    /// What could not be reached.
    fn make_safe(&mut self) -> Result<bool, Fault>;

    /// The measured object was moved by hand; returns when there is a new measurement.
    ///
    /// # Errors
    /// As [`Driver::read`].
    fn moved(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    /// Ends the connection. The device is in its safe state.
    fn disconnect(&mut self);

    /// What commands may be, for each actuator.
    fn limits(&self) -> Vec<Limits>;

    /// When the device is made safe.
    fn timeouts(&self) -> Timeouts;

    /// What must not be opened twice: a serial port, an address.
    fn resource(&self) -> String;

    /// How often [`Driver::work`] must be called \[s\], beside the caller: of a device that must be answered more often than
    /// anybody commands it. `None` where that is never.
    fn period(&self) -> Option<f64> {
        None
    }

    /// Does what is due: takes what the device says, and answers it. It never waits.
    ///
    /// # Errors
    /// The device has fallen silent, or says that it has stopped: why.
    fn work(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    /// What is worth a line in the record and is no fault.
    fn take_note(&mut self) -> Option<String> {
        None
    }

    /// The motion to where an episode begins starts, or ends.
    fn set_resetting(&mut self, _resetting: bool) {}

    /// Whether commands are positions, so that a reset moves the actuators to where an episode begins; otherwise it leaves
    /// them to the person who does that.
    fn resets(&self) -> bool {
        true
    }

    /// Seconds that a reset takes.
    fn reset_duration(&self) -> f64 {
        5.0
    }
}
