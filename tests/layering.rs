//! The order of the modules: `lib.rs` lists them so that each uses only those before it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Names under which modules gather what belongs nowhere.
const REFUSED: [&str; 5] = ["utils", "common", "misc", "helpers", "prelude"];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every source file with its module path: `src/closest/line.rs` is `[closest, line]`, `lib.rs` is `[]`.
fn files() -> Vec<(Vec<String>, String)> {
    fn visit(folder: &Path, found: &mut Vec<(Vec<String>, String)>) {
        for entry in std::fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                visit(&path, found);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let place = path.strip_prefix(source()).expect("a source").with_extension("");
                let names = place.iter().map(|name| name.to_string_lossy().into_owned());
                let module = names.filter(|name| name != "lib").collect();
                found.push((module, without_tests(&path)));
            }
        }
    }
    let mut found = Vec::new();
    visit(&source(), &mut found);
    found
}

/// The code before the unit tests, without comments.
fn without_tests(path: &Path) -> String {
    let text = std::fs::read_to_string(path).expect("a source file");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .collect::<Vec<_>>()
        .join("\n")
}

/// The modules that a file declares, in order.
fn declared(code: &str) -> Vec<String> {
    let line = |line: &str| {
        let words: Vec<&str> = line.trim().trim_end_matches(';').split_whitespace().collect();
        let is_module = line.trim().ends_with(';') && words.len() >= 2;
        (is_module && words[words.len() - 2] == "mod").then(|| words[words.len() - 1].to_string())
    };
    code.lines().filter_map(line).collect()
}

/// First names of the paths that follow `prefix`: `prefix::a::b` gives a, `prefix::{a, b::{c, d}}` gives a and b.
fn first_names<'a>(code: &'a str, prefix: &str) -> BTreeSet<&'a str> {
    let word = |text: &'a str| {
        let text = text.trim_start();
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
        &text[..end]
    };
    let mut names = BTreeSet::new();
    for (at, _) in code.match_indices(prefix) {
        if code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            names.insert(word(rest));
            continue;
        };
        let (mut depth, mut start) = (1, 0);
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            if depth == 0 || (depth == 1 && c == ',') {
                names.insert(word(&group[start..i]));
                start = i + 1;
            }
            if depth == 0 {
                break;
            }
        }
    }
    names
}

#[test]
fn a_file_uses_only_modules_listed_before_its_own() {
    let files = files();
    let (_, root) = files.iter().find(|(module, _)| module.is_empty()).expect("lib.rs");
    let order = declared(root);
    let place = |name: &str| order.iter().position(|module| module == name);
    assert!(order.len() >= 10, "{order:?}");
    for (module, code) in files.iter().filter(|(module, _)| !module.is_empty()) {
        let own = place(&module[0]).unwrap_or_else(|| panic!("{module:?} is not in lib.rs"));
        let from_root = "super::".repeat(module.len());
        for name in first_names(code, "crate::").union(&first_names(code, &from_root)) {
            // A submodule may name its own parent.
            let limit = if module.len() > 1 { own + 1 } else { own };
            let there = place(name);
            assert!(there.is_none_or(|there| there < limit), "{module:?} uses {name}");
        }
    }
}

#[test]
fn the_picture_of_the_modules_shows_each_of_them_in_order() {
    let root = without_tests(&source().join("lib.rs"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| std::fs::read_to_string(folder.join(path)).expect("a document");
    let picture = read("docs/pictures/architecture.svg");
    let shown: Vec<&str> = picture
        .split(r#"class="m">"#)
        .skip(1)
        .map(|rest| rest.split('<').next().unwrap_or_default())
        .collect();
    assert_eq!(shown, declared(&root), "docs/pictures/architecture.py draws it");
    let text = read("ARCHITECTURE.md");
    let chart = text.split("```text").nth(1).and_then(|rest| rest.split("```").next());
    let words: Vec<&str> = chart
        .unwrap_or_default()
        .lines()
        .flat_map(|line| line.get(..44).unwrap_or(line).split(['-', ',', ' ']))
        .collect();
    for module in shown {
        assert!(words.contains(&module), "{module} is not in the chart of ARCHITECTURE.md");
    }
}

#[test]
fn submodules_of_a_module_use_each_other_without_a_circle() {
    let files = files();
    let mut uses: BTreeMap<(&str, &str), BTreeSet<&str>> = BTreeMap::new();
    for (module, code) in files.iter().filter(|(module, _)| module.len() == 2) {
        let siblings: BTreeSet<&str> = files
            .iter()
            .filter(|(m, _)| m.len() == 2 && m[0] == module[0])
            .map(|(m, _)| m[1].as_str())
            .collect();
        let named = first_names(code, "super::")
            .into_iter()
            .filter(|n| siblings.contains(n) && *n != module[1]);
        uses.insert((&module[0], &module[1]), named.collect());
    }
    // Take away what uses nothing any more; what is left then is a circle.
    while let Some(free) = uses.iter().find(|(_, used)| used.is_empty()).map(|(key, _)| *key) {
        uses.remove(&free);
        for (_, used) in uses.iter_mut().filter(|(key, _)| key.0 == free.0) {
            used.remove(free.1);
        }
    }
    assert!(uses.is_empty(), "a circle among {uses:?}");
}

#[test]
fn no_module_is_named_after_nothing() {
    for (module, code) in files() {
        let names = module.iter().chain(&declared(&code)).cloned().collect::<Vec<_>>();
        let refused = names.iter().find(|name| REFUSED.contains(&name.as_str()));
        assert!(refused.is_none(), "{refused:?} in {module:?}");
    }
}

#[test]
fn every_module_says_what_it_is_for_and_no_file_is_longer_than_600_lines() {
    for (module, _) in files().iter().filter(|(module, _)| !module.is_empty()) {
        let path = module.iter().fold(source(), |path, name| path.join(name)).with_extension("rs");
        let text = std::fs::read_to_string(&path).expect("a source file");
        assert!(text.starts_with("//! "), "{module:?} has no head");
        assert!(text.lines().count() <= 600, "{module:?}: {} lines", text.lines().count());
    }
}

#[test]
fn unsafe_code_lives_in_the_c_layer_and_in_vector_kernels_only() {
    for (module, code) in files() {
        let kernels = ["simd/avx2", "simd/avx512", "coefficients/kernels", "coefficients/halve"];
        let in_c_layer = module.first().is_some_and(|name| name == "ffi")
            || kernels.contains(&module.join("/").as_str());
        let has_unsafe =
            code.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == "unsafe");
        assert!(in_c_layer || !has_unsafe, "{module:?}");
    }
}

#[test]
fn the_reader_of_paths_sees_groups_and_nesting() {
    let code =
        "use crate::{a::{x, y}, b}; crate::c::f(); use crate::d; my_crate::e; super::super::g::h;";
    let names: Vec<&str> = first_names(code, "crate::").into_iter().collect();
    assert_eq!(names, ["a", "b", "c", "d"]);
    assert_eq!(first_names(code, "super::super::").into_iter().collect::<Vec<_>>(), ["g"]);
}
