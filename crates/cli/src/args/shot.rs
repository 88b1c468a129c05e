//! Arguments of verbs that render.

/// Which moment of a scene is shown, and how its light is carried.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Shot {
    /// Frame of the sequence: what moves in the scene, and the camera with --orbit, is further on by this many frames
    /// [default: 0]
    #[arg(long, value_name = "K")]
    pub frame: Option<u32>,
    /// Degrees per frame by which the camera goes around what it looks at [default: 0]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub orbit: Option<f32>,
    /// How light is carried: `path-tracing`, or `photon-mapping` with a caustic map and a global map that is gathered
    /// from [default: path-tracing]
    #[arg(long, value_parser = ["path-tracing", "photon-mapping"])]
    pub integrator: Option<String>,
    /// Make photon maps of this many light paths [default with photon-mapping: 200000]; with path tracing they serve the
    /// feature `caustics`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 26))]
    pub photons: Option<u32>,
    /// Light paths for the caustic map [default: five times --photons]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 26), requires = "photons")]
    pub caustic_photons: Option<u32>,
    /// Factor on the radii of looks at the photon maps [default: 1]
    #[arg(long, value_name = "F")]
    pub photon_radius: Option<f32>,
}
