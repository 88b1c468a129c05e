use noisefloor_denoiser::{MethodCard, Need, Registry, Role};
use serde_json::Map;

use crate::names::BASELINE;
use crate::study::MethodRow;

impl MethodRow {
    /// Rows for every registered method that denoises, where `met` says which needs the frames meet: a method as it is if
    /// all of its are, else once for each of the settings under which it does without; one that nothing helps is a row all
    /// the same, which says what it lacks. Then those that claim to be consistent once more, guarded, so that the claim is
    /// proven; the baseline has nothing to guard.
    #[must_use]
    pub fn for_all(registry: &Registry, met: impl Fn(&Need) -> bool) -> Vec<Self> {
        let ready = registry.factories().iter().filter(|factory| factory.ready());
        let built = ready.filter_map(|factory| factory.build(&Map::new()).ok());
        let cards: Vec<MethodCard> =
            built.map(|method| method.card()).filter(|card| card.role == Role::Method).collect();
        let mut rows: Vec<Self> = cards.iter().flat_map(|card| Self::of_card(card, &card.id, &met)).collect();
        for card in cards.iter().filter(|card| card.claims.consistent && card.id != BASELINE) {
            rows.extend(Self::of_card(card, &format!("guarded({})", card.id), &met));
        }
        rows
    }

    /// Rows of one method under this id.
    fn of_card(card: &MethodCard, id: &str, met: &impl Fn(&Need) -> bool) -> Vec<Self> {
        let ways = card.ways_out_where(met);
        if ways.is_empty() {
            return vec![Self::new(id)];
        }
        let with = |way: Vec<noisefloor_denoiser::Setting>| {
            let words: Vec<String> = way.iter().map(ToString::to_string).collect();
            let row = Self::new(id).label(format!("{id} {}", words.join(" ")));
            way.into_iter().fold(row, |row, setting| row.set(&setting.parameter, setting.value))
        };
        ways.into_iter().map(with).collect()
    }
}
