//! Two things: the committed header equals `src/ffi` or the build fails, and the shared library gets its
//! SONAME.

use std::path::Path;
use std::{env, fs};

const HEADER: &str = "include/footpoint.h";
/// Setting this variable writes the header instead of comparing it.
const WRITE: &str = "FOOTPOINT_WRITE_HEADER";
/// The files that hold the C API, in the order in which the header has them.
const SOURCES: [&str; 42] = [
    "src/ffi.rs",
    "src/ffi/records.rs",
    "src/ffi/options.rs",
    "src/ffi/curve.rs",
    "src/ffi/surface.rs",
    "src/ffi/callback.rs",
    "src/ffi/query.rs",
    "src/ffi/floats.rs",
    "src/ffi/sets.rs",
    "src/ffi/lines.rs",
    "src/ffi/normals.rs",
    "src/ffi/path.rs",
    "src/ffi/scene.rs",
    "src/ffi/scene_query.rs",
    "src/ffi/weights_records.rs",
    "src/ffi/weights.rs",
    "src/ffi/weights_report.rs",
    "src/ffi/weights_edit.rs",
    "src/ffi/operate_curve.rs",
    "src/ffi/operate_surface.rs",
    "src/ffi/operate_measure.rs",
    "src/ffi/fit.rs",
    "src/ffi/construct.rs",
    "src/ffi/construct_surface.rs",
    "src/ffi/offset.rs",
    "src/ffi/transform.rs",
    "src/ffi/support.rs",
    "src/ffi/trim.rs",
    "src/ffi/trim_parts.rs",
    "src/ffi/trim_change.rs",
    "src/ffi/trim_report.rs",
    "src/ffi/pcurve.rs",
    "src/ffi/face.rs",
    "src/ffi/march_records.rs",
    "src/ffi/march.rs",
    "src/ffi/march_methods.rs",
    "src/ffi/inspect_records.rs",
    "src/ffi/fair.rs",
    "src/ffi/inspect.rs",
    "src/ffi/intersect_records.rs",
    "src/ffi/intersect.rs",
    "src/ffi/intersect_rays.rs",
];

fn main() {
    for file in SOURCES.iter().chain(&["build.rs", "cbindgen.toml", HEADER]) {
        println!("cargo:rerun-if-changed={file}");
    }
    println!("cargo:rerun-if-env-changed={WRITE}");
    check_header();
    name_shared_library();
}

/// A part of the version in Cargo.toml, "MAJOR", "MINOR" or "PATCH".
fn version(part: &str) -> u32 {
    let name = format!("CARGO_PKG_VERSION_{part}");
    env::var(&name).ok().and_then(|digits| digits.parse().ok()).expect("cargo sets the version")
}

fn check_header() {
    let rendered = render();
    if env::var_os(WRITE).is_some() {
        fs::write(HEADER, &rendered).expect("the header can be written");
    }
    let committed = fs::read_to_string(HEADER).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        committed == rendered,
        "{HEADER} is not what src/ffi says. Refresh it with: {WRITE}=1 cargo build"
    );
}

fn render() -> String {
    let root = env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets the directory");
    let root = Path::new(&root);
    let mut config =
        cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml");
    config.after_includes = Some(macros());
    let builder =
        SOURCES.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| {
            builder.with_src(root.join(file))
        });
    let mut bytes = Vec::new();
    builder.generate().expect("cbindgen reads src/ffi").write(&mut bytes);
    String::from_utf8(bytes).expect("the sources are UTF-8")
}

/// What the header needs besides the items: versions, and the mark of results that must be looked at.
fn macros() -> String {
    let [major, minor, patch] = ["MAJOR", "MINOR", "PATCH"].map(version);
    let abi = if major == 0 { minor } else { major * 1_000 };
    format!(
        "\n/** The version of this header, as fpt_version() returns that of the library. */\n\
         #define FPT_VERSION_MAJOR {major}\n\
         #define FPT_VERSION_MINOR {minor}\n\
         #define FPT_VERSION_PATCH {patch}\n\
         #define FPT_VERSION \
         (FPT_VERSION_MAJOR * 1000000 + FPT_VERSION_MINOR * 1000 + FPT_VERSION_PATCH)\n\
         /** The binary interface of this header, as fpt_abi_version() returns that of the library. */\n\
         #define FPT_ABI_VERSION {abi}\n\n\
         /** A status that is not looked at is a warning. */\n\
         #if defined(__GNUC__) || defined(__clang__)\n\
         #define FPT_MUST_USE __attribute__((warn_unused_result))\n\
         #elif defined(_MSC_VER)\n\
         #define FPT_MUST_USE _Check_return_\n\
         #else\n\
         #define FPT_MUST_USE\n\
         #endif\n"
    )
}

/// 0.MINOR while the major version is 0, then MAJOR: what breaks a compiled caller changes the name.
fn name_shared_library() {
    let (major, minor) = (version("MAJOR"), version("MINOR"));
    let abi = if major == 0 { format!("0.{minor}") } else { major.to_string() };
    match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux") => println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libfootpoint.so.{abi}"),
        Ok("macos") => println!(
            "cargo:rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libfootpoint.{abi}.dylib"
        ),
        _ => {}
    }
}
