#pragma once

#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"

/// Keys of the members of method fem.
namespace sazare::cases {

inline constexpr std::array<std::string_view, 4> member_kinds{"beam", "bar", "spring", "dashpot"};

inline constexpr std::array member_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the member in results and messages."},
    Key{.name = "kind",
        .type = Type::choice,
        .need = Need::required,
        .sentence =
            "beam: bends and stretches (Euler and Bernoulli); bar: stretches only, such as an anchor; spring and dashpot: "
            "along the line between two nodes.",
        .choices = member_kinds},
    Key{.name = "group",
        .type = Type::text,
        .note = "either group, or from and to",
        .sentence = "Physical group of lines of the mesh, along which the member runs from node to node."},
    Key{.name = "from",
        .type = Type::vector,
        .unit = "m",
        .note = "either group, or from and to",
        .sentence = "One end of a straight member: the nearest node, which must be within 1 % of the extent of the mesh."},
    Key{.name = "to", .type = Type::vector, .unit = "m", .note = "either group, or from and to", .sentence = "The other end."},
    Key{.name = "spacing",
        .type = Type::number,
        .unit = "m",
        .range = positive,
        .default_text = "1.0",
        .note = "2-D only",
        .sentence =
            "Distance of such members across the plane: section, mass, prestress, limits, stiffness and damping of each are "
            "divided by it, and forces in results are per metre."},
    Key{.name = "youngs_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .note = "required for beams and bars",
        .sentence = "Young's modulus."},
    Key{.name = "area",
        .type = Type::number,
        .unit = "m2",
        .range = positive,
        .note = "required for beams and bars",
        .sentence = "Area of the section."},
    Key{.name = "second_moment",
        .type = Type::number,
        .unit = "m4",
        .range = positive,
        .note = "required for beams",
        .sentence = "Second moment of area against bending, in space the same in all directions (a round or square section)."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = not_negative,
        .default_text = "0.0",
        .note = "beams and bars; required for beams, where it is above 0",
        .sentence = "Mass per volume."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .high_open = true},
        .default_text = "0.0",
        .note = "beams and bars",
        .sentence = "Damping ratio of Rayleigh damping at the two frequencies of [damping]."},
    Key{.name = "prestress",
        .type = Type::number,
        .unit = "N",
        .default_text = "0.0",
        .note = "bars only",
        .sentence = "Tension of a bar before the body gives way to it; settle includes it."},
    Key{.name = "yield_force",
        .type = Type::number,
        .unit = "N",
        .range = positive,
        .note = "bars and springs; without it elastic",
        .sentence = "Axial force at which it yields, perfectly plastic, in tension and in compression."},
    Key{.name = "compression_force",
        .type = Type::number,
        .unit = "N",
        .range = not_negative,
        .note = "bars and springs; without it that of yield_force",
        .sentence =
            "Compression at which it gives way (buckles) and shortens without damage; 0 for a tie rod or a cable that goes "
            "slack. It bears again when it has its length back."},
    Key{.name = "yield_moment",
        .type = Type::number,
        .unit = "N m",
        .range = positive,
        .note = "beams; without it elastic",
        .sentence = "Plastic moment of the section, at which hinges turn at the ends of its elements, whatever its axial force."},
    Key{.name = "stiffness",
        .type = Type::number,
        .unit = "N/m",
        .range = positive,
        .note = "required for springs",
        .sentence = "Force per elongation."},
    Key{.name = "damping",
        .type = Type::number,
        .unit = "N s/m",
        .range = positive,
        .note = "required for dashpots",
        .sentence = "Force per velocity of elongation."},
};

}  // namespace sazare::cases
