//! Faces as JSON text, for tests and reports of defects: every number comes back with the same bits.
//!
//! ```text
//!   { "format": "footpoint trimmed surface", "version": 1, "flipped": false,
//!     "support": { "kind": "sphere", "domain": [u0, u1, v0, v1], "origin": [..], "x": .., "y": .., "z": .., "radius": 2.0 },
//!     "edges":   [ { "kind": "spline", "reversed": false, "degree": 2, "knots": [..], "poles": [[x, y, z], ..], "weights": [..] },
//!                  { "kind": "point", "reversed": false, "point": [x, y, z] } ],
//!     "loops":   [ { "kind": "outer", "coedges": [ { "edge": 0, "reversed": false, "same_parameter": true,
//!                    "pcurve": { "kind": "isoline", "fixed": "u", "at": 0.0, "from": 0.0, "to": 1.0 } } ] } ] }
//! ```
//!
//! Kinds of supports: spline, plane, cylinder, cone, sphere, torus, revolution, extrusion. Kinds of pcurves: isoline, polyline,
//! spline, arc. What is read goes through the same checks as what is made by calls. Functions cannot be written.

use serde_json::{Map, Value, json};

use super::{Coedge, Edge, EdgeCurve, Loop, LoopKind, Support, TrimmedSurface, invalid};
use crate::bounds::Vector;
use crate::curve::Curve;
use crate::elementary::{Axes, Elementary, ElementarySurface};
use crate::error::Error;
use crate::pcurve::{Direction, Pcurve};
use crate::surface::Surface;

/// What the text begins with.
const FORMAT: &str = "footpoint trimmed surface";
const VERSION: u64 = 1;

impl TrimmedSurface {
    /// The face as JSON text.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for surfaces and curves given by functions.
    pub fn to_json(&self) -> Result<String, Error> {
        let edges = self.edges().iter().map(edge_value).collect::<Result<Vec<_>, _>>()?;
        let loops: Vec<Value> = self.loops().iter().map(loop_value).collect();
        let value = json!({
            "format": FORMAT,
            "version": VERSION,
            "flipped": self.is_flipped(),
            "support": support_value(self.support())?,
            "edges": edges,
            "loops": loops,
        });
        Ok(value.to_string())
    }

    /// The face of a JSON text.
    ///
    /// # Errors
    /// Text that is no JSON, with line and column; an entry that is missing or not allowed, with its path.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let value: Value = serde_json::from_str(text)
            .map_err(|error| Error::InvalidArgument(format!("json: {error}")))?;
        let root = Entry { value: &value, path: "json".into() };
        let format = root.text("format")?;
        if format != FORMAT {
            return invalid(format!("json.format: \"{format}\" is not \"{FORMAT}\""));
        }
        if root.get("version")?.value.as_u64() != Some(VERSION) {
            return Err(Error::Unsupported(format!("json.version: is not {VERSION}")));
        }
        let support = read_support(&root.get("support")?)?;
        let edges = root.list("edges")?.iter().map(read_edge).collect::<Result<Vec<_>, _>>()?;
        let loops = root.list("loops")?.iter().map(read_loop).collect::<Result<Vec<_>, _>>()?;
        Self::new(support, edges, loops, root.truth("flipped")?)
    }
}

fn function<T>(what: &str) -> Result<T, Error> {
    Err(Error::Unsupported(format!("{what} given by a function cannot be written")))
}

/// An object of a kind with the entries of several others.
fn object<const N: usize>(kind: &str, parts: [Value; N]) -> Value {
    let mut map = Map::new();
    map.insert("kind".into(), kind.into());
    for part in parts {
        if let Value::Object(part) = part {
            map.extend(part);
        }
    }
    Value::Object(map)
}

fn curve_value(curve: &Curve) -> Value {
    let mut map = Map::new();
    map.insert("degree".into(), json!(curve.degree()));
    map.insert("knots".into(), json!(curve.knots().values()));
    map.insert("poles".into(), json!(curve.poles()));
    if let Some(weights) = curve.weights() {
        map.insert("weights".into(), json!(weights));
    }
    Value::Object(map)
}

fn axes_value(axes: &Axes) -> Value {
    json!({ "origin": axes.origin, "x": axes.x, "y": axes.y, "z": axes.z })
}

fn support_value(support: &Support) -> Result<Value, Error> {
    let elementary = match support {
        Support::Callback(_) => return function("support: a surface"),
        Support::Spline(spline) => {
            let surface = spline.surface();
            let mut value = json!({
                "kind": "spline",
                "degree_u": surface.knots_u().degree(),
                "degree_v": surface.knots_v().degree(),
                "knots_u": surface.knots_u().values(),
                "knots_v": surface.knots_v().values(),
                "poles": surface.poles(),
            });
            if let (Some(map), Some(weights)) = (value.as_object_mut(), surface.weights()) {
                map.insert("weights".into(), json!(weights));
            }
            return Ok(value);
        }
        Support::Elementary(elementary) => elementary.surface(),
    };
    let domain = json!({ "domain": elementary.domain() });
    Ok(match elementary.kind() {
        Elementary::Plane { axes } => object("plane", [domain, axes_value(axes)]),
        Elementary::Cylinder { axes, radius } => {
            object("cylinder", [domain, axes_value(axes), json!({ "radius": radius })])
        }
        Elementary::Cone { axes, radius, half_angle } => {
            let lengths = json!({ "radius": radius, "half_angle": half_angle });
            object("cone", [domain, axes_value(axes), lengths])
        }
        Elementary::Sphere { axes, radius } => {
            object("sphere", [domain, axes_value(axes), json!({ "radius": radius })])
        }
        Elementary::Torus { axes, major, minor } => {
            let radii = json!({ "major": major, "minor": minor });
            object("torus", [domain, axes_value(axes), radii])
        }
        Elementary::Revolution { origin, axis, meridian } => {
            let line = json!({ "origin": origin, "axis": axis });
            object("revolution", [domain, line, json!({ "meridian": curve_value(meridian) })])
        }
        Elementary::Extrusion { curve, direction } => {
            let way = json!({ "direction": direction });
            object("extrusion", [domain, way, json!({ "curve": curve_value(curve) })])
        }
    })
}

fn edge_value(edge: &Edge) -> Result<Value, Error> {
    let reversed = json!({ "reversed": edge.reversed });
    Ok(match &edge.curve {
        EdgeCurve::Spline(curve) => object("spline", [reversed, curve_value(curve.curve())]),
        EdgeCurve::Point(point) => object("point", [reversed, json!({ "point": point })]),
        EdgeCurve::Callback(_) => return function("edges: a curve"),
    })
}

fn loop_value(chain: &Loop) -> Value {
    let kind = match chain.kind {
        LoopKind::Outer => "outer",
        LoopKind::Inner => "inner",
    };
    let coedge = |coedge: &Coedge| {
        json!({
            "edge": coedge.edge,
            "reversed": coedge.reversed,
            "same_parameter": coedge.same_parameter,
            "pcurve": pcurve_value(&coedge.pcurve),
        })
    };
    let coedges: Vec<Value> = chain.coedges.iter().map(coedge).collect();
    json!({ "kind": kind, "coedges": coedges })
}

fn pcurve_value(pcurve: &Pcurve) -> Value {
    match pcurve {
        Pcurve::Isoline(line) => {
            let fixed = ["u", "v"][line.fixed.index()];
            json!({ "kind": "isoline", "fixed": fixed, "at": line.at, "from": line.from, "to": line.to })
        }
        Pcurve::Polyline(line) => json!({
            "kind": "polyline", "parameters": line.parameters(), "points": line.points(),
        }),
        Pcurve::Spline(curve) => object("spline", [curve_value(curve)]),
        Pcurve::Arc(arc) => json!({
            "kind": "arc", "center": arc.center, "first": arc.first, "second": arc.second,
            "angles": arc.angles,
        }),
    }
}

/// A value and where it stands.
struct Entry<'a> {
    value: &'a Value,
    path: String,
}

impl<'a> Entry<'a> {
    fn refuse<T>(&self, what: &str) -> Result<T, Error> {
        invalid(format!("{}: {what}", self.path))
    }

    /// An error of a constructor, with the path before it.
    fn placed<T>(&self, made: Result<T, Error>) -> Result<T, Error> {
        made.map_err(|error| match error {
            Error::InvalidArgument(text) => {
                Error::InvalidArgument(format!("{}: {text}", self.path))
            }
            other => other,
        })
    }

    fn find(&self, name: &str) -> Option<Entry<'a>> {
        let value = self.value.get(name).filter(|value| !value.is_null())?;
        Some(Entry { value, path: format!("{}.{name}", self.path) })
    }

    fn get(&self, name: &str) -> Result<Entry<'a>, Error> {
        match self.find(name) {
            Some(entry) => Ok(entry),
            None => invalid(format!("{}.{name}: is missing", self.path)),
        }
    }

    fn items(&self) -> Result<Vec<Entry<'a>>, Error> {
        let Some(list) = self.value.as_array() else { return self.refuse("is not a list") };
        let entry = |(k, value)| Entry { value, path: format!("{}[{k}]", self.path) };
        Ok(list.iter().enumerate().map(entry).collect())
    }

    fn list(&self, name: &str) -> Result<Vec<Entry<'a>>, Error> {
        self.get(name)?.items()
    }

    fn text(&self, name: &str) -> Result<&'a str, Error> {
        let entry = self.get(name)?;
        entry.value.as_str().map_or_else(|| entry.refuse("is not a text"), Ok)
    }

    fn truth(&self, name: &str) -> Result<bool, Error> {
        let entry = self.get(name)?;
        entry.value.as_bool().map_or_else(|| entry.refuse("is neither true nor false"), Ok)
    }

    fn count(&self, name: &str) -> Result<usize, Error> {
        let entry = self.get(name)?;
        let count = entry.value.as_u64().and_then(|n| usize::try_from(n).ok());
        count.map_or_else(|| entry.refuse("is not a count"), Ok)
    }

    fn number(&self, name: &str) -> Result<f64, Error> {
        self.get(name)?.as_number()
    }

    fn as_number(&self) -> Result<f64, Error> {
        self.value.as_f64().map_or_else(|| self.refuse("is not a number"), Ok)
    }

    fn numbers(&self, name: &str) -> Result<Vec<f64>, Error> {
        self.list(name)?.iter().map(Entry::as_number).collect()
    }

    fn fixed<const N: usize>(&self, name: &str) -> Result<[f64; N], Error> {
        self.get(name)?.as_fixed()
    }

    fn as_fixed<const N: usize>(&self) -> Result<[f64; N], Error> {
        let list = self.items()?.iter().map(Entry::as_number).collect::<Result<Vec<_>, _>>()?;
        let found = list.len();
        list.try_into().or_else(|_| self.refuse(&format!("has {found} numbers, not {N}")))
    }

    fn places<const N: usize>(&self, name: &str) -> Result<Vec<[f64; N]>, Error> {
        self.list(name)?.iter().map(Entry::as_fixed).collect()
    }
}

fn read_curve(entry: &Entry) -> Result<Curve, Error> {
    let (degree, knots) = (entry.count("degree")?, entry.numbers("knots")?);
    let poles: Vec<Vector> = entry.places("poles")?;
    let weights = entry.find("weights").map(|_| entry.numbers("weights")).transpose()?;
    entry.placed(Curve::new(&knots, degree, &poles, weights.as_deref()))
}

fn read_axes(entry: &Entry) -> Result<Axes, Error> {
    let [origin, x, y, z] =
        [entry.fixed("origin")?, entry.fixed("x")?, entry.fixed("y")?, entry.fixed("z")?];
    Ok(Axes { origin, x, y, z })
}

fn read_support(entry: &Entry) -> Result<Support, Error> {
    let kind = match entry.text("kind")? {
        "spline" => return Ok(read_surface(entry)?.into()),
        "plane" => Elementary::Plane { axes: read_axes(entry)? },
        "cylinder" => {
            Elementary::Cylinder { axes: read_axes(entry)?, radius: entry.number("radius")? }
        }
        "cone" => Elementary::Cone {
            axes: read_axes(entry)?,
            radius: entry.number("radius")?,
            half_angle: entry.number("half_angle")?,
        },
        "sphere" => Elementary::Sphere { axes: read_axes(entry)?, radius: entry.number("radius")? },
        "torus" => Elementary::Torus {
            axes: read_axes(entry)?,
            major: entry.number("major")?,
            minor: entry.number("minor")?,
        },
        "revolution" => Elementary::Revolution {
            origin: entry.fixed("origin")?,
            axis: entry.fixed("axis")?,
            meridian: read_curve(&entry.get("meridian")?)?,
        },
        "extrusion" => Elementary::Extrusion {
            curve: read_curve(&entry.get("curve")?)?,
            direction: entry.fixed("direction")?,
        },
        other => return entry.get("kind")?.refuse(&format!("\"{other}\" is no kind of surface")),
    };
    let domain = entry.fixed("domain")?;
    Ok(entry.placed(ElementarySurface::new(kind, domain))?.into())
}

fn read_surface(entry: &Entry) -> Result<Surface, Error> {
    let degrees = [entry.count("degree_u")?, entry.count("degree_v")?];
    let (knots_u, knots_v) = (entry.numbers("knots_u")?, entry.numbers("knots_v")?);
    let poles: Vec<Vector> = entry.places("poles")?;
    let weights = entry.find("weights").map(|_| entry.numbers("weights")).transpose()?;
    let count = |knots: &[f64], degree: usize| knots.len().saturating_sub(degree.saturating_add(1));
    let counts = [count(&knots_u, degrees[0]), count(&knots_v, degrees[1])];
    let [count_u, count_v] = counts;
    let [degree_u, degree_v] = degrees;
    entry.placed(Surface::new(
        &knots_u,
        &knots_v,
        degree_u,
        degree_v,
        &poles,
        count_u,
        count_v,
        weights.as_deref(),
    ))
}

fn read_edge(entry: &Entry) -> Result<Edge, Error> {
    let edge = match entry.text("kind")? {
        "spline" => Edge::along(read_curve(entry)?),
        "point" => Edge::collapsed(entry.fixed("point")?),
        other => return entry.get("kind")?.refuse(&format!("\"{other}\" is no kind of edge")),
    };
    Ok(Edge { reversed: entry.truth("reversed")?, ..edge })
}

fn read_loop(entry: &Entry) -> Result<Loop, Error> {
    let kind = match entry.text("kind")? {
        "outer" => LoopKind::Outer,
        "inner" => LoopKind::Inner,
        other => return entry.get("kind")?.refuse(&format!("\"{other}\" is no kind of loop")),
    };
    let read = |entry: &Entry| -> Result<Coedge, Error> {
        Ok(Coedge {
            pcurve: read_pcurve(&entry.get("pcurve")?)?,
            edge: entry.find("edge").map(|_| entry.count("edge")).transpose()?,
            reversed: entry.truth("reversed")?,
            same_parameter: entry.truth("same_parameter")?,
        })
    };
    let coedges = entry.list("coedges")?.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    Ok(Loop { kind, coedges })
}

fn read_pcurve(entry: &Entry) -> Result<Pcurve, Error> {
    let made = match entry.text("kind")? {
        "isoline" => {
            let fixed = match entry.text("fixed")? {
                "u" => Direction::U,
                "v" => Direction::V,
                _ => return entry.get("fixed")?.refuse("is neither \"u\" nor \"v\""),
            };
            let [at, from, to] = [entry.number("at")?, entry.number("from")?, entry.number("to")?];
            Pcurve::isoline(fixed, at, from, to)
        }
        "polyline" => Pcurve::polyline_at(&entry.numbers("parameters")?, &entry.places("points")?),
        "spline" => Pcurve::spline(read_curve(entry)?),
        "arc" => Pcurve::arc(
            entry.fixed("center")?,
            entry.fixed("first")?,
            entry.fixed("second")?,
            entry.fixed("angles")?,
        ),
        other => return entry.get("kind")?.refuse(&format!("\"{other}\" is no kind of pcurve")),
    };
    entry.placed(made)
}
