use std::collections::BTreeSet;

use noisefloor_denoiser::{BuildError, Entry, MC_ENTRY};
use serde_json::{Map, Value, json};

use crate::{builtin, methods_table, params_table, readme, registry};

fn overrides(value: Value) -> Map<String, Value> {
    value.as_object().cloned().unwrap_or_default()
}

#[test]
fn documented_parameters_are_exactly_the_fields_of_the_defaults() {
    for entry in builtin() {
        let documented: Vec<&str> = entry.params.iter().map(|p| p.name).collect();
        let unique: BTreeSet<&str> = documented.iter().copied().collect();
        assert_eq!(unique.len(), documented.len(), "{}: a parameter is documented twice", entry.id);
        let defaults = (entry.defaults)();
        let fields: BTreeSet<&str> = defaults.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(unique, fields, "{}", entry.id);
        for param in entry.params {
            assert!(!param.range.is_empty() && !param.about.is_empty(), "{}.{}", entry.id, param.name);
        }
    }
}

#[test]
fn the_page_of_a_method_names_it_and_belongs_to_no_other() {
    for entry in builtin() {
        match readme(entry) {
            Some(page) => assert!(page.contains(&format!("`{}`", entry.id)), "{}", entry.id),
            None => assert_eq!(entry.id, MC_ENTRY.id),
        }
        assert_eq!(readme(&Entry { summary: "mine", ..*entry }), None);
    }
}

#[test]
fn ids_are_unique_and_defaults_build_under_their_own_id() {
    let ids: BTreeSet<&str> = builtin().iter().map(|e| e.id).collect();
    assert_eq!(ids.len(), builtin().len());
    let registry = registry(&[]);
    for entry in builtin() {
        let method = registry.build(entry.id, &Map::new()).unwrap();
        assert_eq!(method.denoiser.card().id, entry.id);
        assert_eq!(method.params, (entry.defaults)());
        // Every default is also a valid override.
        let all = overrides((entry.defaults)());
        assert_eq!(registry.build(entry.id, &all).unwrap().params, (entry.defaults)());
    }
}

#[test]
fn every_parameter_rejects_a_value_of_the_wrong_type_with_its_range() {
    let registry = registry(&[]);
    for entry in builtin() {
        for param in entry.params {
            let wrong = overrides(json!({ param.name: [1, 2] }));
            match registry.build(entry.id, &wrong) {
                Err(BuildError::OutOfRange { method, parameter, range, .. }) => {
                    assert_eq!((method.as_str(), parameter.as_str()), (entry.id, param.name));
                    assert_eq!(range, param.range);
                }
                other => panic!("{}.{}: {other:?}", entry.id, param.name),
            }
        }
    }
}

#[test]
fn unknown_names_list_the_nearest_ones_with_their_ranges() {
    let registry = registry(&[]);
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
    let inner = registry.build("guarded(nfor)", &Map::new()).unwrap_err();
    assert!(matches!(inner, BuildError::UnknownMethod { ref id, .. } if id == "nfor"));
}

#[test]
fn guarded_wraps_any_method_and_itself() {
    let registry = registry(&[]);
    for entry in builtin() {
        let id = format!("guarded({})", entry.id);
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
fn an_extra_entry_joins_or_replaces() {
    let renamed = Entry { id: "my-method", summary: "mine", ..MC_ENTRY };
    let replaced = Entry { summary: "mine", ..MC_ENTRY };
    let registry = registry(&[renamed, replaced]);
    assert_eq!(registry.entries().len(), builtin().len() + 1);
    assert_eq!(registry.entries()[0].summary, "mine");
    assert!(registry.build("my-method", &Map::new()).is_ok());
}

#[test]
fn tables_list_every_method_and_parameter_in_equal_columns() {
    let methods = methods_table(builtin());
    assert_eq!(methods.lines().count(), builtin().len() + 2);
    for entry in builtin() {
        assert!(methods.contains(&format!("| `{}` |", entry.id)));
        let params = params_table(entry);
        for param in entry.params {
            assert!(params.contains(&format!("| `{}` |", param.name)));
        }
        for line in params.lines() {
            assert_eq!(line.replace("\\|", "").matches('|').count(), 5, "{line}");
        }
    }
}
