//! Content hashes: what has the same key has the same numbers.

use serde::Serialize;

/// Raise when anything changes what a key stands for.
const KEY_VERSION: u32 = 1;

/// A content hash in hexadecimal.
pub type Key = String;

/// Hash of a serialisable description. Maps are sorted by `serde_json`, so equal descriptions have equal keys.
pub fn key_of(description: &impl Serialize) -> Key {
    let value = serde_json::to_value(description).unwrap_or_default();
    let mut hasher = blake3::Hasher::new();
    hasher.update(&KEY_VERSION.to_le_bytes());
    hasher.update(value.to_string().as_bytes());
    hasher.finalize().to_hex()[..32].to_owned()
}

/// First 8 bytes of the hash of a description: a random seed.
///
/// # Panics
/// Never: a hash has 32 bytes.
pub fn seed_of(description: &impl Serialize) -> u64 {
    let value = serde_json::to_value(description).unwrap_or_default();
    let hash = blake3::hash(value.to_string().as_bytes());
    u64::from_le_bytes(hash.as_bytes()[..8].try_into().expect("a hash has 32 bytes"))
}
