#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/methods/hybrid/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 3> schemes{"paper", "impulse", "repeat"};

constexpr std::array side_keys{
    Key{.name = "continuum",
        .type = Type::file,
        .need = Need::required,
        .sentence =
            "Case of method fem, relative to this file; its step is the window in which the sides exchange motion for force, "
            "and it may also be run alone."},
    Key{.name = "bodies",
        .type = Type::file,
        .need = Need::required,
        .sentence =
            "Case of method spheres, rectangles or blocks with the same end and intervals; its step divides the window, and is "
            "chosen so where it "
            "is not given."},
};

constexpr std::array surface_keys{
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of outer faces of the continuum (in 2-D of lines) that the bodies feel as a moving wall."},
    Key{.name = "material",
        .type = Type::text,
        .note = "required for bodies of method spheres, and only for them",
        .sentence =
            "Material of the bodies' case of which the surface is in contact; rectangles and blocks have one contact law."},
    Key{.name = "width",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required for spheres and blocks where the continuum is in 2-D, and only there",
        .sentence = "Width along z of the slab of bodies whose forces the plane gets per metre."},
};

constexpr std::array coupling_keys{
    Key{.name = "scheme",
        .type = Type::choice,
        .default_text = "\"impulse\"",
        .sentence =
            "Force with which the continuum goes through a window: paper takes that at the end of the window before, impulse the "
            "mean of the window before, repeat goes through it again until force and motion agree.",
        .choices = schemes},
    Key{.name = "tolerance",
        .type = Type::number,
        .range = {.low = 1e-13, .high = 0.1},
        .default_text = "1e-4",
        .note = "scheme repeat",
        .sentence = "Difference between the force that was tried and the one that came of it, over the larger."},
    Key{.name = "passes",
        .type = Type::integer,
        .range = {.low = 2, .high = 1000},
        .default_text = "20",
        .note = "scheme repeat",
        .sentence = "Through a window, at most."},
};

constexpr std::array tables{
    case_table,
    Table{"sides", false, Need::required, "The two cases that are coupled.", side_keys},
    Table{"surface", false, Need::required, "Where they touch.", surface_keys},
    Table{"coupling", false, Need::optional, "How force and motion are exchanged.", coupling_keys},
    output_table,
};

}  // namespace

std::span<const Table> hybrid_schema() { return tables; }

}  // namespace sazare::cases
