//! Simulated devices (`robohive-wire`) under the clients that other people wrote for the real ones: what both sides of this
//! project read in a document may be read wrongly by both, and these read it for themselves.
//!
//! | client | devices | tests |
//! |---|---|---|
//! | dynamixel2, rustypot | Dynamixel servos with protocol 2.0 | `dynamixel_clients.rs` |
//! | rustypot | Dynamixel servos with protocol 1.0 | `dynamixel_v1_client.rs` |
//! | rustypot | Feetech servos | `feetech_client.rs` |
//! | franka-rs | Franka arms and hands | `franka_client.rs` |
//! | natnet | OptiTrack trackers | `natnet_client.rs`, `natnet_frames.rs` |
//!
//! A package of its own, since these clients take minutes to compile and nothing else needs them. They run on pseudo-terminals
//! and sockets of this machine, in real time.
