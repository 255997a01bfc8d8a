//! Which model an id or the data of a simulation belong to, so that debug builds refuse ids of other models.

#[cfg(debug_assertions)]
use crate::arrays::{Arrays, ObjType};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

/// The structure of the model that an id was found in, or that data were made for: a digest in debug builds, empty in
/// release builds. All origins are equal, so that ids compare and hash alike in both builds.
#[derive(Clone, Copy, Default)]
pub(crate) struct Origin {
    #[cfg(debug_assertions)]
    fingerprint: u64,
}

impl Origin {
    /// In debug builds, panics when the two structures differ.
    #[inline]
    #[track_caller]
    pub fn check(self, _used_with: Origin) {
        #[cfg(debug_assertions)]
        assert!(
            self.fingerprint == _used_with.fingerprint,
            "this id belongs to another model: find it again by name in the model it is used with"
        );
    }

    /// Digest (FNV-1a) of what ids rely on: how many elements there are of each kind, their addresses and names.
    #[cfg(debug_assertions)]
    pub fn of(m: &Arrays) -> Self {
        let mut digest: u64 = 0xcbf2_9ce4_8422_2325;
        let mut add = |bytes: &[u8]| {
            for byte in bytes {
                digest = (digest ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
            }
        };
        for size in [m.nq, m.nv, m.na, m.nu, m.nmocap, m.nsensordata, m.names.len()] {
            add(&(size as u64).to_le_bytes());
        }
        let addresses: [&[i32]; 12] = [
            &m.body_mocapid,
            &m.jnt_type,
            &m.jnt_qposadr,
            &m.jnt_dofadr,
            &m.actuator_ctrladr,
            &m.actuator_ctrlnum,
            &m.actuator_actadr,
            &m.actuator_actnum,
            &m.actuator_outadr,
            &m.actuator_outnum,
            &m.sensor_adr,
            &m.sensor_dim,
        ];
        let kinds = (0..=ObjType::Plugin.code()).filter_map(ObjType::from_code);
        for list in addresses.into_iter().chain(kinds.map(|kind| m.name_addresses(kind))) {
            add(&(list.len() as u64).to_le_bytes());
            list.iter().for_each(|address| add(&address.to_le_bytes()));
        }
        add(&m.names);
        Origin { fingerprint: digest }
    }
}

impl std::fmt::Debug for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Origin")
    }
}

impl PartialEq for Origin {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Origin {}

impl PartialOrd for Origin {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Origin {
    fn cmp(&self, _: &Self) -> Ordering {
        Ordering::Equal
    }
}

impl Hash for Origin {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}
