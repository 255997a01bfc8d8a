//! Cyclic redundancy checks of 16 bits.

/// CRC-16 with polynomial 0x8005, most significant bit first, from `crc` on: Dynamixel protocol 2.0 begins with 0.
///
/// ```
/// let ping = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01];
/// assert_eq!(robohive_protocol::crc::buypass(0, &ping), 0x4E19);
/// ```
pub fn buypass(crc: u16, bytes: &[u8]) -> u16 {
    bytes.iter().fold(crc, |crc, &byte| crc << 8 ^ REMAINDERS[usize::from((crc >> 8) as u8 ^ byte)])
}

/// What is left of each byte, most significant bit first.
const REMAINDERS: [u16; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut rest = (byte as u16) << 8;
        let mut bit = 0;
        while bit < 8 {
            rest = if rest & 0x8000 != 0 { rest << 1 ^ 0x8005 } else { rest << 1 };
            bit += 1;
        }
        table[byte] = rest;
        byte += 1;
    }
    table
};

/// CRC-16 with polynomial 0x8005, least significant bit first, that begins with 0xFFFF: Modbus RTU sends its low byte first.
///
/// ```
/// let read = [0x09, 0x04, 0x07, 0xD0, 0x00, 0x03];
/// assert_eq!(robohive_protocol::crc::modbus(&read).to_le_bytes(), [0xB1, 0xCE]);
/// ```
pub fn modbus(bytes: &[u8]) -> u16 {
    bytes.iter().fold(0xFFFF, |crc, &byte| {
        (0..8).fold(crc ^ u16::from(byte), |crc, _| if crc & 1 != 0 { crc >> 1 ^ 0xA001 } else { crc >> 1 })
    })
}
