use std::collections::BTreeSet;

use noisefloor_denoiser::{BuildError, MonteCarlo, NoParams, method};
use serde_json::{Map, Value, json};

use crate::{builtin, guests, params_table, registry};

fn overrides(value: Value) -> Map<String, Value> {
    value.as_object().cloned().unwrap_or_default()
}

#[test]
fn the_page_of_a_method_names_it_and_its_table_is_that_of_the_parameters() {
    for factory in builtin().into_iter().chain(guests()) {
        let Some(page) = factory.readme() else {
            assert_eq!(factory.id(), "mc");
            continue;
        };
        assert!(page.contains(&format!("`{}`", factory.id())), "{}", factory.id());
        let table = params_table(factory.params());
        assert!(page.contains(&table), "the table of {} should be\n{table}", factory.id());
    }
}

#[test]
fn ids_are_unique_and_defaults_build_under_their_own_id() {
    let ids: BTreeSet<String> = builtin().iter().map(|f| f.id().to_owned()).collect();
    assert_eq!(ids.len(), builtin().len());
    let registry = registry([]);
    for factory in builtin() {
        let method = registry.build(factory.id(), &Map::new()).unwrap();
        assert_eq!(method.denoiser.card().id, factory.id());
        assert_eq!(method.params, Value::Object(factory.defaults()));
        // Every default is also a valid override.
        let all = registry.build(factory.id(), &factory.defaults()).unwrap();
        assert_eq!(all.params, Value::Object(factory.defaults()));
        assert!(
            factory.params().iter().all(|p| !p.about.is_empty() && p.allows(&p.default)),
            "{}",
            factory.id()
        );
    }
}

#[test]
fn every_method_has_a_complete_entry_of_a_bibliography() {
    let registry = registry([]);
    let mut entries = std::collections::BTreeMap::new();
    for factory in builtin() {
        let citation = registry.build(factory.id(), &Map::new()).unwrap().denoiser.card().citation;
        let entry = citation.entry.unwrap_or_else(|| panic!("{} has no entry", factory.id()));
        assert!(entry.missing().is_empty(), "{}: {:?}", factory.id(), entry.missing());
        // What people read says the same.
        assert!(citation.text.contains(&entry.year.to_string()), "{}", factory.id());
        let text = citation.text.to_lowercase();
        assert!(text.contains(&entry.title.to_lowercase()), "{}: {}", factory.id(), entry.title);
        let last = |name: &str| name.rsplit(' ').next().unwrap_or_default().to_lowercase();
        for author in entry.authors.split(" and ") {
            assert!(text.contains(&last(author)), "{}: {author}", factory.id());
        }
        // One key, one source.
        assert_eq!(*entries.entry(citation.key).or_insert(entry), entry, "{}", factory.id());
    }
}

#[test]
fn every_parameter_rejects_a_value_of_the_wrong_type_with_its_range() {
    let registry = registry([]);
    for factory in builtin() {
        for param in factory.params() {
            let wrong = overrides(json!({ param.name.as_str(): [1, 2] }));
            match registry.build(factory.id(), &wrong) {
                Err(BuildError::OutOfRange { method, parameter, range, .. }) => {
                    assert_eq!((method.as_str(), &parameter), (factory.id(), &param.name));
                    assert_eq!(range, param.range());
                }
                other => panic!("{}.{}: {other:?}", factory.id(), param.name),
            }
        }
    }
}

#[test]
fn unknown_names_list_the_nearest_ones_with_their_ranges() {
    let registry = registry([]);
    match registry.build("geometric-corected", &Map::new()) {
        Err(BuildError::UnknownMethod { nearest, .. }) => assert_eq!(nearest[0], "geometric-corrected"),
        other => panic!("{other:?}"),
    }
    let error = registry
        .build("geometric-corrected", &overrides(json!({ "radius_max": 3 })))
        .unwrap_err()
        .to_string();
    assert!(error.contains("radius_max_px (0 to 64 px)"), "{error}");
    let error = registry
        .build("geometric-corrected", &overrides(json!({ "radius_max_px": 65 })))
        .unwrap_err()
        .to_string();
    assert!(error.contains("radius_max_px") && error.contains("65") && error.contains("0 to 64"), "{error}");
    let inner = registry.build("guarded(nothing)", &Map::new()).unwrap_err();
    assert!(matches!(inner, BuildError::UnknownMethod { ref id, .. } if id == "nothing"));
}

#[test]
fn guarded_wraps_any_method_and_itself() {
    let registry = registry([]);
    for factory in builtin() {
        let id = format!("guarded({})", factory.id());
        let method = registry.build(&id, &overrides(json!({ "guard_level": 0.95 }))).unwrap();
        assert_eq!(method.denoiser.card().id, id);
        assert_eq!(method.params["guard_level"], 0.95);
    }
    let twice = registry.build("guarded(guarded(mc))", &Map::new()).unwrap();
    assert_eq!(twice.denoiser.card().id, "guarded(guarded(mc))");
    let through = registry
        .build("guarded(geometric-corrected)", &overrides(json!({ "multiplier": 3.0, "guard_level": 0.9 })))
        .unwrap();
    assert_eq!((&through.params["multiplier"], &through.params["guard_level"]), (&json!(3.0), &json!(0.9)));
}

#[test]
fn an_extra_method_joins_or_replaces() {
    let extra = |id: &str| method(id, "mine", None, |_: NoParams| Ok(MonteCarlo));
    let registry = registry([extra("my-method"), extra("mc")]);
    assert_eq!(registry.factories().len(), builtin().len() + guests().len() + 1);
    assert_eq!(registry.factories()[0].summary(), "mine");
    assert!(registry.build("my-method", &Map::new()).is_ok());
}

#[test]
fn tables_list_every_parameter_in_equal_columns() {
    for factory in builtin() {
        let table = params_table(factory.params());
        for param in factory.params() {
            assert!(table.contains(&format!("| `{}` |", param.name)));
        }
        for line in table.lines() {
            assert_eq!(line.replace("\\|", "").matches('|').count(), 7, "{line}");
        }
    }
}
