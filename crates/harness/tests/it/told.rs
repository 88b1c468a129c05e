//! What a method tells of one image: its own seconds, its own bound, and what it said meanwhile.

use noisefloor_study::record::{Outcome, Record};

use crate::common::{Place, SMALL, Watch, records, study};

/// Records of the row `talker` with these settings, at 4 samples with standard deviation 0.5.
fn run(place: &Place, set: &str) -> Vec<Record> {
    let toml = SMALL
        .replace("spp = [4, 16]", "spp = [4]")
        .replace("id = \"blur\"", &format!("id = \"talker\"\nset = {{ {set} }}"));
    place.run(&study(&toml), &Watch::default()).unwrap();
    records(&place.out()).into_iter().filter(|record| record.method == "talker").collect()
}

#[test]
fn its_bound_is_counted_like_any_other_and_proves_nothing() {
    // 1.96 standard deviations of a mean of four: 5 % of the values are outside. Two replicates of 24×16×3 values.
    for (width, expected, tolerance) in [(0.49, 0.05, 0.02), (1e6, 0.0, 0.0), (0.0, 1.0, 0.0)] {
        let found = run(&Place::new(), &format!("width = {width:?}"));
        let all: Vec<_> = found.iter().flat_map(|r| &r.bounds).filter(|b| b.class == "all").collect();
        assert_eq!(all.len(), 2, "{all:?}");
        assert!(
            all.iter().all(|b| b.claim == "of this image" && !b.proven && b.total == 24 * 16 * 3),
            "{all:?}"
        );
        let rate = all.iter().map(|b| b.violations).sum::<u64>() as f64 / (2 * 24 * 16 * 3) as f64;
        assert!((rate - expected).abs() <= tolerance, "half-width {width}: {rate}");
    }
}

#[test]
fn its_own_seconds_count_where_they_can_be_true() {
    for record in run(&Place::new(), "seconds = 0.0") {
        assert_eq!((record.outcome, record.seconds.denoise), (Outcome::Done, Some(0.0)));
        assert!(record.seconds.around.is_some_and(|around| around > 0.0), "{:?}", record.seconds);
    }
    for lie in ["seconds = 1e9", "seconds = -1.0"] {
        for record in run(&Place::new(), lie) {
            assert_eq!(record.seconds.around, None, "{lie}");
            assert!(record.seconds.denoise.is_some_and(|own| own > 0.0 && own < 1e3), "{:?}", record.seconds);
        }
    }
}

#[test]
fn what_it_said_is_kept_beside_the_images() {
    let place = Place::new();
    for record in run(&place, "width = 1.0") {
        let log = record.log.expect("a path in the folder");
        assert_eq!(std::fs::read_to_string(place.out().join(log)).unwrap(), "read, thought, wrote\n");
    }
}
