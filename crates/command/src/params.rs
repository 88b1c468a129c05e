use noisefloor_denoiser::parameters;

parameters! {
    /// Parameters of `command`.
    pub struct Params {
        /// The program and its arguments, with files for `{input}`, `{output}`, `{albedo.pfm}` and so on; split like a shell
        /// does, run without one.
        run: String = String::new(), text();
        /// Name of the method in lists and reports; the program's where empty.
        name: String = String::new(), text();
        /// What of `{input}` it cannot do without, by the names of buffers: `variance`, `halfA`, `albedo`, `albedo.variance`,
        /// `flash`. What the command line names itself is needed anyway.
        needs: Vec<String> = Vec::new(), names(32);
        /// Seconds after which it is stopped.
        limit_s: f64 = 600.0, number(0.1..=1e6).unit("s");
        /// Text in its output after which stands how long it computed; none where empty and it writes no `{seconds}`.
        seconds_after: String = String::new(), text();
        /// What that number is in: 0.001 for milliseconds.
        seconds_unit: f64 = 1.0, number(1e-9..=3600.0).unit("s");
    }
}
