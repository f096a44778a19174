#pragma once

/// Keys of the weight and the stress of the ground.

#include "sazare/cases/case_keys.hpp"

namespace sazare::cases {

/// In either table: a run begins with one or the other, or both.
inline constexpr Key settle_key{
    .name = "settle",
    .type = Type::boolean,
    .default_text = "false",
    .sentence =
        "Begin in equilibrium, under gravity and the initial stress together: it is found first, absorbing boundaries keep "
        "carrying their reactions in it, and displacements and energies count from it.",
};

inline constexpr std::array block_gravity_keys{gravity_keys.front(), settle_key};

inline constexpr std::string_view instead_of_k0 = "instead of k0; tension positive";

inline constexpr std::array initial_stress_keys{
    Key{.name = "normal_stress",
        .type = Type::vector,
        .unit = "Pa",
        .default_text = "[0.0, 0.0, 0.0]",
        .note = instead_of_k0,
        .sentence = "Stresses xx, yy, zz at the datum."},
    Key{.name = "shear_stress",
        .type = Type::vector,
        .unit = "Pa",
        .default_text = "[0.0, 0.0, 0.0]",
        .note = instead_of_k0,
        .sentence = "Stresses xy, yz, zx at the datum."},
    Key{.name = "normal_stress_per_depth",
        .type = Type::vector,
        .unit = "Pa/m",
        .default_text = "[0.0, 0.0, 0.0]",
        .note = instead_of_k0,
        .sentence = "What is added to xx, yy, zz per metre of depth below the datum."},
    Key{.name = "shear_stress_per_depth",
        .type = Type::vector,
        .unit = "Pa/m",
        .default_text = "[0.0, 0.0, 0.0]",
        .note = instead_of_k0,
        .sentence = "What is added to xy, yz, zx per metre of depth below the datum."},
    Key{.name = "k0",
        .type = Type::number,
        .range = not_negative,
        .note = "instead of the stresses; needs gravity along an axis",
        .sentence = "Ratio of horizontal to vertical stress; the vertical stress is the weight of the ground between a place and "
                    "the datum, its surface."},
    Key{.name = "datum",
        .type = Type::number,
        .unit = "m",
        .default_text = "0.0",
        .sentence = "Height of the plane from which depth is measured: along z, or against gravity where there is gravity."},
    settle_key,
};

}  // namespace sazare::cases
