//! Names of exported files: ids of scenes are free, so what is made of them may meet.

use std::collections::BTreeSet;

use noisefloor_study::exhibit::{Document, Part};

/// Gives tables whose id another one has a number behind it.
pub(super) fn name_apart(document: &mut Document) {
    // Upper and lower case are one on some file systems.
    let mut taken: BTreeSet<String> =
        document.front.board.iter().map(|board| board.id.to_lowercase()).collect();
    for exhibit in &mut document.exhibits {
        visit(&mut exhibit.parts, &mut |id| {
            let given = id.clone();
            let mut n = 2;
            while !taken.insert(id.to_lowercase()) {
                *id = format!("{given}-{n}");
                n += 1;
            }
        });
    }
}

fn visit(parts: &mut [Part], name: &mut dyn FnMut(&mut String)) {
    for part in parts {
        match part {
            Part::Table(table) => name(&mut table.id),
            Part::Folded { parts, .. } | Part::Level { parts, .. } => visit(parts, name),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use noisefloor_study::exhibit::{Exhibit, Table};

    use super::*;

    #[test]
    fn tables_of_one_name_are_told_apart() {
        let table = |id: &str| Part::Table(Table { id: id.into(), ..Table::default() });
        let folded = Part::folded("more", vec![table("A"), table("a-2")]);
        let parts = vec![table("a"), folded, table("b")];
        let exhibit = Exhibit { id: "x".into(), name: String::new(), title: String::new(), parts };
        let mut document = Document { exhibits: vec![exhibit], ..Document::default() };
        name_apart(&mut document);
        let ids: Vec<&str> = document.tables().iter().map(|table| table.id.as_str()).collect();
        assert_eq!(ids, ["a", "A-2", "a-2-2", "b"]);
    }
}
