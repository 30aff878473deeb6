// footpoint.hpp in a page: a surface, its nearest points, all parameters of a point, a scene, an error.
//
//   c++ -std=c++17 -O2 tour.cpp -o tour -lfootpoint
#include <footpoint.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

int main() try {
    // A square of 30 mm with a hill in its middle.
    const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1};
    std::vector<double> poles;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) poles.insert(poles.end(), {10.0 * i, 10.0 * j, i % 3 && j % 3 ? 12.0 : 0.0});
    const footpoint::surface hill(3, 3, knots, knots, poles);

    // Arrays may be vectors, arrays or lists in braces; one query is a batch of one.
    const fpt_foot_point foot = hill.closest({12, 17, 9}).at(0);
    std::printf("nearest: S(%.6f, %.6f), %.6f mm away%s\n", foot.u, foot.v, foot.distance,
                foot.flags & FPT_FOOT_NOT_PROVEN ? "" : ", proven");

    // All places where the distance is stationary, nearest first.
    for (const fpt_foot_member &member : hill.extrema({15, 15, 3}))
        std::printf("  %s at (%.4f, %.4f), %.4f mm\n",
                    member.nature == FPT_NATURE_MINIMUM ? "minimum" : member.nature == FPT_NATURE_MAXIMUM ? "maximum" : "saddle",
                    member.foot.u, member.foot.v, member.foot.distance);

    // The side of the surface.
    const std::vector<double> points{12, 17, 9, 12, 17, 5};
    for (const double distance : hill.normals(points, hill.closest(points)).signed_distances)
        std::printf("signed distance %.4f mm\n", distance);

    // Two places of one surface as a scene.
    const footpoint::placement aside{1, 0, 0, 50, 0, 1, 0, 0, 0, 0, 1, 0};
    const footpoint::scene scene({footpoint::scene::member(hill), footpoint::scene::member(hill, aside)});
    std::printf("a point at x = 70 belongs to member %u\n", scene.closest({70, 5, -3}).members.at(0));

    // Wrong input is thrown, with the place of the mistake.
    poles[3 * 5 + 1] = NAN;
    try {
        footpoint::surface(3, 3, knots, knots, poles);
    } catch (const footpoint::error &failure) {
        std::printf("%s: %s\n", failure.status_name(), failure.what());
    }
    return 0;
} catch (const footpoint::error &failure) {
    std::fprintf(stderr, "%s: %s\n", failure.status_name(), failure.what());
    return 1;
}
