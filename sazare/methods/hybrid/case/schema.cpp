#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/methods/hybrid/case/format.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 4> schemes{"automatic", "lagged", "impulse", "iterative"};

constexpr std::array side_keys{
    Key{.name = "continuum",
        .type = Type::file,
        .need = Need::required,
        .sentence = "Case of finite elements, relative to this file; its time step is the coupling window, at whose ends the two "
                    "solvers exchange force and motion; it may also be run alone."},
    Key{.name = "bodies",
        .type = Type::file,
        .need = Need::required,
        .sentence =
            "Case of method spheres, rectangles, blocks or mps with the same end and intervals; its time step divides the "
            "coupling window, and is chosen accordingly where it is not given."},
};

constexpr std::array surface_keys{
    Key{.name = "group",
        .type = Type::text,
        .need = Need::required,
        .sentence = "Physical group of outer faces of the continuum (lines in 2-D), which acts on the bodies as a moving wall."},
    Key{.name = "material",
        .type = Type::text,
        .note = "required for bodies of method spheres, and only for them",
        .sentence = "Material of the bodies' case that the surface has in contact; rectangles and blocks have one contact law."},
    Key{.name = "friction_coefficient",
        .type = Type::number,
        .range = not_negative,
        .note = "required for bodies of method mps, and only for them",
        .sentence =
            "Friction between the ground and the surface; of a wall often two thirds of the ground's friction angle, as a "
            "tangent. The surface has no cohesion with the ground."},
    Key{.name = "width",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .note = "required for spheres and blocks where the continuum is in 2-D, and only there",
        .sentence = "Width along z of the slab of bodies, by which forces are divided: a continuum in 2-D takes them per metre."},
};

constexpr std::array coupling_keys{
    Key{.name = "scheme",
        .type = Type::choice,
        .default_text = "\"automatic\"",
        .sentence = "Force on the continuum in a coupling window: lagged: that at the end of the window before; impulse: the "
                    "mean of the window before; iterative: found by repeating the window until force and motion agree; automatic: "
                    "the mean of the window before, and windows in which more than a hundredth of the force differs are repeated.",
        .choices = schemes},
    Key{.name = "tolerance",
        .type = Type::number,
        .range = {.low = 1e-13, .high = 0.1},
        .default_text = "1e-4",
        .note = "scheme iterative",
        .sentence = "Difference between the assumed and the resulting force, divided by the larger of the two."},
    Key{.name = "max_passes",
        .type = Type::integer,
        .range = {.low = 2, .high = 1000},
        .default_text = "20",
        .note = "schemes iterative and automatic",
        .sentence = "Maximum passes through a coupling window."},
};

constexpr std::array tables{
    case_table,
    Table{"sides", false, Need::required, "The two cases that are coupled: continuum and bodies.", side_keys},
    Table{"surface", false, Need::required, "Coupling surface.", surface_keys},
    Table{"coupling", false, Need::optional, "Coupling scheme: how force and motion are exchanged.", coupling_keys},
    output_table,
};

}  // namespace

std::span<const Table> hybrid_schema() { return tables; }

}  // namespace sazare::cases
