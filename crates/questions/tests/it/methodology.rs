//! The methodology is made of the questions' own paragraphs.

use std::path::Path;

use noisefloor_questions::QUESTIONS;

#[test]
fn the_methodology_has_every_questions_paragraph_word_for_word() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../METHODOLOGY.md");
    let text = std::fs::read_to_string(&path).unwrap();
    for question in QUESTIONS {
        let id = question.id;
        let paragraph = question.methodology;
        assert!(
            paragraph.starts_with("## ") && paragraph.len() > 200,
            "`{id}` does not say how it is answered"
        );
        let block = format!("<!-- question {id} -->\n{paragraph}<!-- /question -->\n");
        assert!(text.contains(&block), "put this into METHODOLOGY.md for `{id}`:\n{block}");
    }
    assert_eq!(text.matches("<!-- question ").count(), QUESTIONS.len(), "a paragraph without a question");
}
