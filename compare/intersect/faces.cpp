// Faces of solids that OpenCASCADE makes against faces of moved copies: footpoint beside GeomAPI_IntSS.
//
//   faces [COUNT] [SEED] [LIST.csv]      COUNT pairs of which one of the two finds something; 200
//
// Each face counts as its surface over the box of its parameters. What both find is compared as sets in space: samples of the
// curves of one are asked for their distance from the curves of the other, and, certified, from both surfaces. Each pair runs in a process
// of its own: OpenCASCADE may crash or take long. A line of LIST.csv is a pair; at the end the differences, one by one.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "solids.h"

#include <footpoint_occt.hxx>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomAPI_IntSS.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <csignal>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fo = footpoint::occt;

namespace {

constexpr double TOLERANCE = 1e-7;
constexpr int SAMPLES = 48;
constexpr int SECONDS = 60; // of processor time

using Surface = Handle(Geom_Surface);
using Curve = Handle(Geom_Curve);

double processor_time() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

Surface surface_of(const TopoDS_Face &face) {
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    return new Geom_RectangularTrimmedSurface(fo::detail::basis(BRep_Tool::Surface(face)), u0, u1, v0, v1);
}

footpoint::surface converted(const Surface &shape) {
    fo::detail::range u{}, v{};
    shape->Bounds(u.low, u.high, v.low, v.high);
    return fo::detail::made(*fo::detail::net_of(fo::detail::plain(fo::detail::basis(shape)), u, v), gp_Trsf());
}

footpoint::curve converted(const Curve &curve) {
    return fo::detail::made(*fo::detail::profile_of(fo::detail::basis(curve), {curve->FirstParameter(), curve->LastParameter()}), gp_Trsf());
}

// What one of the two found.
struct Found {
    bool done = false;
    double seconds = 0;
    std::vector<Curve> lines;
};

struct Sample {
    std::array<double, 3> at;
    double weight; // its share of the length
    std::size_t line;
};

std::vector<Sample> samples(const std::vector<Curve> &lines) {
    std::vector<Sample> out;
    for (std::size_t n = 0; n < lines.size(); n++) {
        const double a = lines[n]->FirstParameter(), b = lines[n]->LastParameter();
        gp_Pnt before = lines[n]->Value(a);
        for (int k = 0; k <= SAMPLES; k++) {
            const gp_Pnt p = lines[n]->Value(a + (b - a) * k / SAMPLES);
            out.push_back({{p.X(), p.Y(), p.Z()}, p.Distance(before), n});
            before = p;
        }
    }
    return out;
}

std::vector<double> flat(const std::vector<Sample> &list) {
    std::vector<double> out;
    for (const Sample &s : list) out.insert(out.end(), s.at.begin(), s.at.end());
    return out;
}

std::vector<double> distances(const std::vector<Sample> &from, const std::vector<Curve> &to) {
    std::vector<double> least(from.size(), HUGE_VAL);
    if (from.empty()) return least;
    for (const Curve &line : to) {
        const auto feet = converted(line).closest(flat(from));
        for (std::size_t k = 0; k < feet.size(); k++) least[k] = std::min(least[k], feet[k].distance);
    }
    return least;
}

// Connected components of curves joined at their ends, and how many of them have no loose end.
std::array<int, 2> components(const std::vector<Curve> &lines, double near) {
    const std::size_t n = lines.size();
    std::vector<std::size_t> of(n);
    for (std::size_t k = 0; k < n; k++) of[k] = k;
    std::function<std::size_t(std::size_t)> root = [&](std::size_t k) { return of[k] == k ? k : of[k] = root(of[k]); };
    const auto end = [&](std::size_t k, int which) { return lines[k]->Value(which ? lines[k]->LastParameter() : lines[k]->FirstParameter()); };
    std::vector<std::array<bool, 2>> joined(n, {false, false});
    for (std::size_t a = 0; a < n; a++)
        for (int i = 0; i < 2; i++)
            for (std::size_t b = a; b < n; b++)
                for (int j = 0; j < 2; j++) {
                    if (a == b && i >= j) continue;
                    if (end(a, i).Distance(end(b, j)) > near) continue;
                    joined[a][std::size_t(i)] = joined[b][std::size_t(j)] = true;
                    of[root(a)] = root(b);
                }
    std::map<std::size_t, bool> closed;
    for (std::size_t k = 0; k < n; k++) {
        const auto [entry, fresh] = closed.emplace(root(k), true);
        entry->second = entry->second && joined[k][0] && joined[k][1];
    }
    std::array<int, 2> out{int(closed.size()), 0};
    for (const auto &[key, is] : closed) out[1] += is;
    return out;
}

// Sine of the angle between the surfaces near a point.
double angle(const footpoint::surface &a, const footpoint::surface &b, const std::array<double, 3> &at) {
    const auto normal = [&](const footpoint::surface &s) {
        const auto foot = s.closest(std::vector<double>(at.begin(), at.end()))[0];
        const std::vector<double> d = s.evaluate(foot.u, foot.v, 1);
        return gp_Vec(d[3], d[4], d[5]).Crossed(gp_Vec(d[6], d[7], d[8]));
    };
    const gp_Vec p = normal(a), q = normal(b);
    return p.Crossed(q).Magnitude() / std::max(p.Magnitude() * q.Magnitude(), 1e-300);
}

bool in_boxes(const std::vector<std::array<double, 8>> &boxes, const footpoint::surface &a, const footpoint::surface &b,
              const std::array<double, 3> &at) {
    const std::vector<double> p(at.begin(), at.end());
    const auto f = a.closest(p)[0], g = b.closest(p)[0];
    const double place[4] = {f.u, f.v, g.u, g.v};
    const auto da = a.domain(), db = b.domain();
    const double size[4] = {da[1] - da[0], da[3] - da[2], db[1] - db[0], db[3] - db[2]};
    return std::any_of(boxes.begin(), boxes.end(), [&](const std::array<double, 8> &box) {
        for (int k = 0; k < 4; k++)
            if (place[k] < box[2 * k] - 1e-3 * size[k] || place[k] > box[2 * k + 1] + 1e-3 * size[k]) return false;
        return true;
    });
}

// What the parent reads: one line.
struct Report {
    int ours[2] = {0, 0}, theirs[2] = {0, 0}, lines[2] = {0, 0}; // components and closed ones; curves
    int contacts = 0, overlaps = 0, undecided = 0, proven = 0;
    double time[2] = {0, 0};
    double off[2] = {0, 0};      // certified: greatest distance of the samples from a surface, of the size
    double apart[2] = {0, 0};    // greatest distance of ours from theirs, of theirs from ours, of the size
    double alone[2] = {0, 0};    // length that only we, only they have, of the size
    double real_alone = 0;       // of theirs alone: on both surfaces within 1e-6 of the size
    double listed = 0;           // of that: in an overlap or an undecided box of ours
    double angle[2] = {1, 1};    // least sine of the angle at what only one has
    double loops_alone = 0;      // closed branches of ours of which no sample is theirs
    char note[160] = "";
};

void compare(const Surface &s, const Surface &t, Report &out) {
    const footpoint::surface a = converted(s), b = converted(t);
    Bnd_Box box;
    BndLib_AddSurface::Add(GeomAdaptor_Surface(s), 0, box);
    const double size = std::sqrt(box.SquareExtent());
    const double near = 1e-5 * size;
    Found ours, theirs;
    fo::GeomAPI_IntSS mine;
    ours.seconds = theirs.seconds = HUGE_VAL;
    for (int run = 0; run < 3; run++) {
        double start = processor_time();
        mine.Perform(s, t, TOLERANCE);
        ours.seconds = std::min(ours.seconds, processor_time() - start);
        try {
            start = processor_time();
            GeomAPI_IntSS other(s, t, TOLERANCE);
            theirs.done = other.IsDone();
            theirs.seconds = std::min(theirs.seconds, processor_time() - start);
            theirs.lines.clear();
            for (int k = 1; theirs.done && k <= other.NbLines(); k++) theirs.lines.push_back(other.Line(k));
        } catch (const Standard_Failure &failure) {
            std::snprintf(out.note, sizeof out.note, "OpenCASCADE: %s", failure.GetMessageString());
            theirs.seconds = std::min(theirs.seconds, processor_time() - start);
        }
        if (ours.seconds + theirs.seconds > 2) break;
    }
    if (!theirs.done && !out.note[0]) std::snprintf(out.note, sizeof out.note, "OpenCASCADE: not done");
    for (int k = 1; k <= mine.NbLines(); k++) ours.lines.push_back(mine.Line(k));
    const auto summary = mine.Intersection().summary();
    out.contacts = int(summary.contact_count), out.overlaps = int(summary.overlap_count), out.undecided = int(summary.undecided_count);
    out.proven = int(summary.is_proven);
    std::vector<std::array<double, 8>> boxes;
    for (int k = 0; k < out.overlaps; k++) boxes.push_back(mine.Intersection().overlap(std::size_t(k)));
    for (int k = 0; k < out.undecided; k++) boxes.push_back(mine.Intersection().undecided(std::size_t(k)));
    const Found *both[2] = {&ours, &theirs};
    std::vector<Sample> all[2];
    for (int k = 0; k < 2; k++) {
        all[k] = samples(both[k]->lines);
        const auto count = components(both[k]->lines, near);
        (k ? out.theirs : out.ours)[0] = count[0];
        (k ? out.theirs : out.ours)[1] = count[1];
        out.lines[k] = int(both[k]->lines.size());
        out.time[k] = both[k]->seconds;
    }
    for (int k = 0; k < 2; k++) {
        if (all[k].empty()) continue;
        const auto points = flat(all[k]);
        const auto f = a.closest(points), g = b.closest(points);
        const auto apart = distances(all[k], both[1 - k]->lines);
        std::vector<int> matched(both[k]->lines.size(), 0);
        for (std::size_t i = 0; i < all[k].size(); i++) {
            const double off = std::max(f[i].distance, g[i].distance);
            out.off[k] = std::max(out.off[k], off / size);
            if (std::isfinite(apart[i])) out.apart[k] = std::max(out.apart[k], apart[i] / size);
            if (apart[i] <= near) {
                matched[all[k][i].line]++;
                continue;
            }
            out.alone[k] += all[k][i].weight / size;
            out.angle[k] = std::min(out.angle[k], angle(a, b, all[k][i].at));
            if (k == 1 && off <= 1e-6 * size) {
                out.real_alone += all[k][i].weight / size;
                if (in_boxes(boxes, a, b, all[k][i].at)) out.listed += all[k][i].weight / size;
            }
        }
        if (k == 0)
            for (std::size_t n = 0; n < ours.lines.size(); n++) {
                const Curve &c = ours.lines[n];
                if (!matched[n] && c->Value(c->FirstParameter()).Distance(c->Value(c->LastParameter())) < near) out.loops_alone++;
            }
    }
}

// Runs a comparison in a child; false when it crashed or took too long.
bool guarded(const Surface &s, const Surface &t, Report &out) {
    int ends[2];
    if (pipe(ends)) return false;
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        const rlimit limit{SECONDS, SECONDS + 1};
        setrlimit(RLIMIT_CPU, &limit);
        Report report;
        try {
            compare(s, t, report);
        } catch (const std::exception &error) {
            std::snprintf(report.note, sizeof report.note, "ours: %s", error.what());
        } catch (const Standard_Failure &error) {
            std::snprintf(report.note, sizeof report.note, "ours: %s", error.GetMessageString());
        }
        const bool written = write(ends[1], &report, sizeof report) == ssize_t(sizeof report);
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    const bool ready = read(ends[0], &out, sizeof out) == ssize_t(sizeof out);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (!ready) std::snprintf(out.note, sizeof out.note, WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU ? "longer than %d s" : "crashed", SECONDS);
    return ready;
}

const char *verdict(const Report &r) {
    if (r.note[0]) return "failed";
    const bool more = r.alone[0] > 1e-3, less = r.alone[1] > 1e-3;
    if (!more && !less) {
        if (r.ours[0] == r.theirs[0] && r.ours[1] == r.theirs[1]) return "same";
        return r.alone[0] + r.alone[1] > 0 ? "same but for crumbs" : "same set, joined otherwise";
    }
    if (less && r.real_alone > 1e-3) return r.listed > 0.9 * r.real_alone ? "ours: listed as overlap or undecided" : "OURS MISSING";
    if (less && more) return "both differ";
    if (less) return "OCCT: not on both surfaces";
    if (r.theirs[0] == 0) return "OCCT finds nothing";
    if (r.loops_alone > 0) return "OCCT lost a loop";
    return "OCCT lost a piece";
}

struct Face {
    TopoDS_Face face;
    Bnd_Box box;
};

std::vector<Face> faces(const TopoDS_Shape &shape) {
    std::vector<Face> out;
    for (TopExp_Explorer walk(shape, TopAbs_FACE); walk.More(); walk.Next()) {
        Face f{TopoDS::Face(walk.Current()), {}};
        BRepBndLib::Add(f.face, f.box);
        out.push_back(f);
    }
    return out;
}

std::string kind(const Surface &s) {
    const std::string name = fo::detail::basis(s)->DynamicType()->Name();
    return name.substr(5);
}

double median(std::vector<double> list) {
    if (list.empty()) return 0;
    std::sort(list.begin(), list.end());
    return list[list.size() / 2];
}

} // namespace

int main(int argc, char **argv) {
    const int wanted = argc > 1 ? std::atoi(argv[1]) : 200;
    std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    FILE *list = std::fopen(argc > 3 ? argv[3] : "/dev/null", "w");
    if (!list) return 2;
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto all = solids();
    std::map<std::string, int> counts;
    std::vector<double> ratios, our_times, their_times;
    std::vector<std::string> differences;
    int found = 0, empty = 0, wrong = 0;
    std::fprintf(list, "pair,solid,first,second,motion,verdict,ours,ours_closed,occt,occt_closed,contacts,overlaps,undecided,proven,off_ours,"
                       "off_occt,ours_from_occt,occt_from_ours,only_ours,only_occt,real_only_occt,angle,ms_ours,ms_occt,note\n");
    for (int round = 0; found < wanted && round < 4000; round++) {
        const Solid &solid = all[std::size_t(round) % all.size()];
        // Shifted and turned; every fourth one moved so that planes and axes stay together.
        gp_Trsf motion, shift;
        Bnd_Box box;
        BRepBndLib::Add(solid.shape, box);
        const double reach = 0.25 * std::sqrt(box.SquareExtent());
        const int special = (round / int(all.size())) % 4;
        const char *how = "turned and shifted";
        if (special != 3) {
            const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
            const gp_Pnt middle((low.XYZ() + high.XYZ()) / 2);
            motion.SetRotation(gp_Ax1(middle, gp_Dir(between(-1, 1), between(-1, 1), between(-1, 1))), between(0.1, 3));
            shift.SetTranslation(gp_Vec(between(-reach, reach), between(-reach, reach), between(-reach, reach)));
        } else if (round % 2) {
            how = "shifted along x";
            shift.SetTranslation(gp_Vec(between(-reach, reach), 0, 0));
        } else {
            how = "turned about z";
            motion.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), between(0.1, 3));
        }
        const TopoDS_Shape copy = BRepBuilderAPI_Transform(solid.shape, shift * motion, true);
        auto first = faces(solid.shape), second = faces(copy);
        std::shuffle(first.begin(), first.end(), random);
        std::shuffle(second.begin(), second.end(), random);
        bool taken = false;
        for (const Face &f : first) {
            for (const Face &g : second) {
                if (taken || f.box.IsOut(g.box)) continue;
                const Surface s = surface_of(f.face), t = surface_of(g.face);
                Report r;
                guarded(s, t, r);
                const bool nothing = !r.note[0] && r.lines[0] + r.lines[1] + r.contacts + r.overlaps + r.undecided == 0;
                if (nothing) {
                    empty++;
                    continue;
                }
                taken = true;
                found++;
                const std::string what = verdict(r);
                counts[what]++;
                wrong += what == "OURS MISSING" || (what == "failed" && !std::strncmp(r.note, "ours", 4));
                if (r.time[0] > 0 && r.time[1] > 0) {
                    ratios.push_back(r.time[1] / r.time[0]);
                    our_times.push_back(r.time[0]);
                    their_times.push_back(r.time[1]);
                }
                std::fprintf(list, "%d,%s,%s,%s,%s,%s,%d,%d,%d,%d,%d,%d,%d,%d,%.1e,%.1e,%.1e,%.1e,%.4f,%.4f,%.4f,%.1e,%.3f,%.3f,%s\n", found,
                             solid.name.c_str(), kind(s).c_str(), kind(t).c_str(), how, what.c_str(), r.ours[0], r.ours[1], r.theirs[0],
                             r.theirs[1], r.contacts, r.overlaps, r.undecided, r.proven, r.off[0], r.off[1], r.apart[0], r.apart[1],
                             r.alone[0], r.alone[1], r.real_alone, std::min(r.angle[0], r.angle[1]), 1e3 * r.time[0], 1e3 * r.time[1], r.note);
                std::fflush(list);
                if (const char *folder = std::getenv("PAIRS_KEEP"); folder && what != "same") {
                    const std::string base = std::string(folder) + "/" + std::to_string(found);
                    BRepTools::Write(f.face, (base + "a.brep").c_str());
                    BRepTools::Write(g.face, (base + "b.brep").c_str());
                }
                if (what != "same") {
                    char line[640];
                    std::snprintf(line, sizeof line, "%4d %-18s %-28s %-28s %-18s %s: ours %d (%d closed, %d contacts, %d overlaps, %d undecided), "
                                                     "OCCT %d (%d closed); only ours %.3f, only OCCT %.3f of the size, sine of the angle there %.0e %s",
                                  found, solid.name.c_str(), kind(s).c_str(), kind(t).c_str(), how, what.c_str(), r.ours[0], r.ours[1], r.contacts,
                                  r.overlaps, r.undecided, r.theirs[0], r.theirs[1], r.alone[0], r.alone[1], std::min(r.angle[0], r.angle[1]), r.note);
                    differences.push_back(line);
                }
            }
        }
    }
    std::printf("%d pairs of which one finds something, %d of which neither does\n", found, empty);
    for (const auto &[name, count] : counts) std::printf("%5d  %s\n", count, name.c_str());
    std::printf("medians: ours %.2f ms, GeomAPI_IntSS %.2f ms, ratio %.1f\n", 1e3 * median(our_times), 1e3 * median(their_times), median(ratios));
    for (const std::string &line : differences) std::printf("%s\n", line.c_str());
    std::fclose(list);
    return wrong > 0;
}
