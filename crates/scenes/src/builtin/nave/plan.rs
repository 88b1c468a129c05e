//! Measures that the parts of the nave share.

/// Bays between columns, and the length of one.
pub const BAYS: u32 = 8;
pub const BAY: f32 = 4.0;
/// Where the first bay begins.
pub const NEAR: f32 = 8.0;
pub const FAR: f32 = NEAR - BAY * BAYS as f32;
/// Inner faces of the nave's and the aisles' walls on either side of the axis.
pub const NAVE: f32 = 3.2;
pub const AISLE: f32 = 7.2;
/// Height of the springing of the vault.
pub const VAULT: f32 = 9.3;
