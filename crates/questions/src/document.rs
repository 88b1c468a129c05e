//! Everything that a page shows of a study, put together.

mod about;
mod banners;
mod facts;
mod gallery;
mod methods;
mod unique;

use noisefloor_study::exhibit::{Answer, Chart, Document, Exhibit, Front};
use noisefloor_study::summary::Summary;

use crate::list::QUESTIONS;
use crate::view::View;
use crate::{convergence, error};

/// What a reader sees of a study.
#[must_use]
pub fn document(summary: &Summary) -> Document {
    let view = View::new(summary);
    let study = &summary.study;
    let mut document = Document {
        study: study.name.clone(),
        title: study.title.clone(),
        question: study.question.clone(),
        reproduces: study.reproduces.clone(),
        analysis: study.analysis.clone(),
        command: study.command.clone(),
        environment: facts::environment(&summary.environment),
        version: summary.environment.version.clone(),
        date: summary.environment.date.clone(),
        banners: banners::banners(summary),
        levels: study.spp.clone(),
        chosen: view.default_spp(),
        rows: view.looks(),
        front: Front {
            answers: answers(&view),
            charts: first_chart(&view).into_iter().collect(),
            board: error::board(&view),
            cards: error::cards(&view),
        },
        exhibits: exhibits(&view),
        gallery: gallery::gallery(&view),
        metric: view.primary().1,
    };
    unique::name_apart(&mut document);
    document
}

/// The first screen's sentences.
pub(crate) fn answers(view: &View<'_>) -> Vec<Answer> {
    QUESTIONS.iter().filter_map(|question| (question.answer)(view)).collect()
}

/// Errors of the first scene that has any: the same chart as in its section.
fn first_chart(view: &View<'_>) -> Option<Chart> {
    let (metric, _) = view.primary();
    let mut scenes = view.named_scenes().filter(|_| view.draws("convergence"));
    scenes.find_map(|(scene, name)| convergence::chart(view, scene, &name, metric))
}

/// The first exhibit of every question, then the further ones, then what explains the page.
fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let (mut first, mut further) = (Vec::new(), Vec::new());
    for question in QUESTIONS {
        let mut of_question = (question.exhibits)(view).into_iter();
        first.extend(of_question.next());
        further.extend(of_question);
    }
    first.into_iter().chain(further).chain([methods::methods(view), about::about()]).collect()
}
