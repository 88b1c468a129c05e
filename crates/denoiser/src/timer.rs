use std::time::Instant;

use crate::StageSeconds;

/// Times the stages of a method, so that methods themselves never read a clock.
#[derive(Debug)]
pub struct StageTimer {
    last: Instant,
    stages: Vec<StageSeconds>,
}

impl StageTimer {
    /// Starts the clock of the first stage.
    #[must_use]
    pub fn start() -> Self {
        Self { last: Instant::now(), stages: Vec::new() }
    }

    /// Ends the running stage and starts the next.
    pub fn finish(&mut self, name: &'static str) {
        let now = Instant::now();
        self.stages.push(StageSeconds { name: name.into(), seconds: (now - self.last).as_secs_f64() });
        self.last = now;
    }

    /// The finished stages in order.
    #[must_use]
    pub fn into_stages(self) -> Vec<StageSeconds> {
        self.stages
    }
}
