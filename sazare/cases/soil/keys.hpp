#pragma once

#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"

/// Keys of soil that degrades with strain.
namespace sazare::cases {

inline constexpr std::array<std::string_view, 4> backbones{"hyperbolic", "ramberg_osgood", "table", "general_hyperbolic"};

inline constexpr std::array soil_keys{
    Key{.name = "backbone",
        .type = Type::choice,
        .note = "default: the stiffness does not depend on the strain; not with a cohesion",
        .sentence =
            "Soil that degrades with shear strain and dissipates by Masing's rules: stress of a first loading in shear, a "
            "hyperbola, the curve of Ramberg and Osgood, a table of G/G0, or the general hyperbolic equation (GHE). G0 is the "
            "shear modulus of the elastic material.",
        .choices = backbones},
    Key{.name = "reference_strain",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true},
        .usual = usual::reference_strain,
        .note = "hyperbolic and ramberg_osgood; default of hyperbolic: shear_strength/G0",
        .sentence = "Shear strain at which G/G0 = 0.5."},
    Key{.name = "shear_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::strength,
        .note = "with a backbone; required for ramberg_osgood and general_hyperbolic; default of hyperbolic: G0 "
                "reference_strain, of a table: the stress of its last row",
        .sentence = "Shear strength, at which the backbone ends."},
    Key{.name = "ramberg_osgood_exponent",
        .type = Type::number,
        .range = {.low = 1, .high = 20, .low_open = true},
        .note = "required for ramberg_osgood",
        .sentence = "Exponent r of strain = stress/G0 (1 + (2 stress/(G0 reference_strain))^(r - 1))."},
    Key{.name = "ghe_c1_end",
        .type = Type::number,
        .range = positive,
        .note = "required for general_hyperbolic",
        .sentence = "C1 of the general hyperbolic equation at large strains; at none it is 1."},
    Key{.name = "ghe_c2_begin",
        .type = Type::number,
        .range = positive,
        .note = "required for general_hyperbolic",
        .sentence = "C2 of the general hyperbolic equation at no strain."},
    Key{.name = "ghe_c2_end",
        .type = Type::number,
        .range = positive,
        .note = "required for general_hyperbolic",
        .sentence = "C2 of the general hyperbolic equation at large strains."},
    Key{.name = "ghe_alpha",
        .type = Type::number,
        .range = positive,
        .note = "required for general_hyperbolic",
        .sentence = "Strain over reference strain (shear_strength/G0) at which C1 is half way."},
    Key{.name = "ghe_beta",
        .type = Type::number,
        .range = positive,
        .note = "required for general_hyperbolic",
        .sentence = "Strain over reference strain at which C2 is half way."},
    Key{.name = "modulus_reduction",
        .type = Type::file,
        .note = "required for a table",
        .sentence =
            "CSV with the header \"shear_strain [-],modulus_ratio [-]\", strains in - or %: G/G0 falls from 1. A third column "
            "\"damping_ratio [-]\" (or %) is only compared with what Masing's rules give."},
    Key{.name = "yield_surfaces",
        .type = Type::integer,
        .range = {.low = 3, .high = 200},
        .default_text = "30",
        .note = "not of a table",
        .sentence =
            "Number of elastic-perfectly plastic parts, which are the corners of the backbone; a table has one for each row."},
};

}  // namespace sazare::cases
