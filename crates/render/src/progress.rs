use std::ops::ControlFlow;

/// Is told about finished pixels, from any thread.
///
/// Closures `Fn(usize) -> ControlFlow<()>` are progress callbacks too.
pub trait Progress: Sync {
    /// `pixels` more pixels are done; all of them add up to width × height. Called a few times per millisecond at
    /// most, so it should be cheap. [`ControlFlow::Break`] cancels the rendering.
    fn advance(&self, pixels: usize) -> ControlFlow<()>;
}

impl<F: Fn(usize) -> ControlFlow<()> + Sync> Progress for F {
    fn advance(&self, pixels: usize) -> ControlFlow<()> {
        self(pixels)
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _: usize) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
