/// A source of nearly normal numbers with mean 0, for any standard deviation: the same sequence on every machine.
pub fn noise() -> impl FnMut(f32) -> f32 {
    let mut state = 1u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    // Twelve uniform numbers have the variance 1.
    move |error: f32| error * ((0..12).map(|_| uniform()).sum::<f32>() - 6.0)
}

/// Brightness of flat surfaces of 40×40 pixels, 0.2 to 1.
pub fn surfaces(channel: usize, x: usize, y: usize) -> f32 {
    0.2 + 0.1 * ((x / 40 * 3 + y / 40 * 5 + channel) % 9) as f32
}
