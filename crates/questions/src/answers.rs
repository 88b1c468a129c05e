//! Answers on disk: of a cell, a level or a study, under their question's id.

use std::collections::BTreeMap;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Keeps an answer. All of them are plain data, which is always written.
pub(crate) fn keep<T: Serialize>(answers: &mut BTreeMap<String, Value>, id: &str, answer: &T) {
    if let Ok(value) = serde_json::to_value(answer) {
        answers.insert(id.to_owned(), value);
    }
}

/// Reads an answer; nothing where there is none, or where another program tells it in another form.
pub(crate) fn read<T: DeserializeOwned>(answers: &BTreeMap<String, Value>, id: &str) -> Option<T> {
    answers.get(id).and_then(|value| T::deserialize(value).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_comes_back_and_one_of_another_form_is_none() {
        let mut answers = BTreeMap::new();
        keep(&mut answers, "q", &vec![1.5, 2.5]);
        assert_eq!(read::<Vec<f64>>(&answers, "q"), Some(vec![1.5, 2.5]));
        assert_eq!(read::<Vec<String>>(&answers, "q"), None);
        assert_eq!(read::<Vec<f64>>(&answers, "other"), None);
    }
}
