//! Names under which other programs write what methods read here under ours.

use noisefloor_frame::FeatureId;

use crate::names::Statistic;

/// Our name, and what others call it: last piece of the layer's name, in lower case without spaces, dashes and
/// underscores.
const ALIASES: &[(&str, &[&str])] = &[
    (
        "albedo",
        &[
            "denoisingalbedo",
            "visiblediffuse",
            "diffuse",
            "diffcol",
            "diffusealbedo",
            "basecolor",
            "diffusecolor",
        ],
    ),
    (
        "normal",
        &[
            "n",
            "ns",
            "normals",
            "denoisingnormal",
            "visiblenormals",
            "optixnormals",
            "shnormal",
            "geonormal",
            "shadingnormal",
        ],
    ),
    ("depth", &["z", "denoisingdepth", "zdepth"]),
    ("visibility", &["shadow"]),
    ("motion", &["vector", "motionvector", "motionvectors"]),
    ("material", &["materialid", "matid", "indexma"]),
    ("variance", &["var", "colorvariance"]),
    ("halfA", &["colora", "buffera"]),
    ("halfB", &["colorb", "bufferb"]),
    ("samples", &["samplecount", "nsamples", "spp"]),
];

/// Layers that are no features.
const OTHERS: [&str; 8] =
    ["variance", "halfA", "halfB", "samples", "flash", "flashBase", "flashLight", "flashCov"];

/// Least similarity of a misspelt name, of at least this many letters.
const SIMILAR: (f64, usize) = (0.8, 5);

/// The name that a layer, which no method reads under its own, may have been meant to have.
pub(crate) fn meant(name: &str) -> Option<String> {
    let (prefix, last) = name.rsplit_once('.').unwrap_or(("", name));
    let given = plain(last);
    // A statistic of a layer that exists: `albedo.Variance`.
    let statistic =
        Statistic::ALL.into_iter().map(Statistic::suffix).find(|s| plain(s) == given && !s.is_empty());
    if let Some(statistic) = statistic.filter(|_| !prefix.is_empty()) {
        let feature = FeatureId::KNOWN.iter().find(|id| id.name().eq_ignore_ascii_case(prefix));
        return feature.map(|id| format!("{}.{statistic}", id.name()));
    }
    let ours = || FeatureId::KNOWN.iter().map(FeatureId::name).chain(OTHERS);
    if let Some(same) = ours().find(|ours| plain(ours) == given) {
        return Some(same.to_owned());
    }
    if let Some((ours, _)) = ALIASES.iter().find(|(_, others)| others.contains(&given.as_str())) {
        return Some((*ours).to_owned());
    }
    let alike = |ours: &str| strsim::normalized_damerau_levenshtein(&plain(ours), &given);
    let near = ours().filter(|ours| ours.len() >= SIMILAR.1 && alike(ours) >= SIMILAR.0);
    near.max_by(|a, b| alike(a).total_cmp(&alike(b))).map(str::to_owned)
}

/// What is said about such a layer; `there` says whether the file has the other layer as well.
pub(crate) fn words(ours: &str, there: bool) -> String {
    if there {
        return format!("read by no method, as `{ours}` is there too");
    }
    let mut text = format!("read by no method; did you mean `{ours}`?");
    if ours == "variance" {
        text.push_str(
            " That is the variance of the mean; some programs write that of one sample under such a name",
        );
    }
    text
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::meant;

    #[test]
    fn names_of_other_programs_and_slips_are_told_from_other_layers() {
        for (name, ours) in [
            ("Albedo", "albedo"),
            ("ViewLayer.Denoising Albedo", "albedo"),
            ("Ns", "normal"),
            ("N", "normal"),
            ("Normal", "normal"),
            ("normals", "normal"),
            ("albdo", "albedo"),
            ("Z", "depth"),
            ("Depth", "depth"),
            ("halfa", "halfA"),
            ("HALFB", "halfB"),
            ("Variance", "variance"),
            ("albedo.Variance", "albedo.variance"),
            ("Albedo.halfb", "albedo.halfB"),
            ("FlashBase", "flashBase"),
            ("Vector", "motion"),
        ] {
            assert_eq!(meant(name).as_deref(), Some(ours), "{name}");
        }
        for name in [
            "A",
            "P",
            "u",
            "v",
            "dzdx",
            "uv",
            "View.Pos",
            "position",
            "emission",
            "RelativeVariance",
            "mine.variance",
        ] {
            assert_eq!(meant(name), None, "{name}");
        }
    }
}
