use noisefloor_frame::{FeatureHit, PixelFilter, Reference, Sampling};

use crate::study::{Family, MethodRow, ReferenceSpec, Replicates, SceneSpec, Study, Timing};

impl Study {
    /// What a study is that says no more than its scenes, levels and rows: one replicate, 160×120, a reference of 1024
    /// samples.
    #[must_use]
    pub fn plain(name: String, spp: Vec<u32>, scenes: Vec<SceneSpec>, methods: Vec<MethodRow>) -> Self {
        let metrics = crate::metric::ids();
        Self {
            title: name.clone(),
            name,
            question: String::new(),
            analysis: Vec::new(),
            reproduces: None,
            spp,
            replicates: Replicates::uniform(1),
            width: 160,
            height: 120,
            depth: 8,
            filter: PixelFilter::Box,
            feature_hit: FeatureHit::First,
            intervals: Vec::new(),
            membership: false,
            statistics: Vec::new(),
            seed: 0,
            sampling: Sampling::Independent,
            reference: ReferenceSpec {
                spp: 1024,
                parts: Reference::LEAST_PARTS as u32,
                sampling: Sampling::LowDiscrepancy,
            },
            scenes,
            methods,
            primary_metric: crate::metric::primary(&metrics),
            metrics,
            coverage: vec![0.95, 0.99, 0.998],
            timing: Timing::default(),
            comparison: Family::AllPairs,
            viewer_spp: Vec::new(),
            probe: None,
            figures: Vec::new(),
            compare: Vec::new(),
        }
    }
}
