#pragma once

#include <array>

#include "sazare/cases/case_keys.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/cases/law_keys.hpp"
#include "sazare/cases/soil/keys.hpp"

/// Keys of the materials of method fem.
namespace sazare::cases {

inline constexpr std::array<std::string_view, 3> drainages{"drained", "undrained", "flow"};

inline constexpr std::string_view with_strength = "only with a cohesion";
inline constexpr UsualRange water_density{990, 1050};  // [kg/m3]

inline constexpr std::array own_material_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the material in messages."},
    Key{.name = "regions",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Physical groups of the mesh that consist of the material: surfaces in 2-D, volumes in 3-D."},
    Key{.name = "density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .need = Need::required,
        .sentence = "Mass per volume."},
    Key{.name = "youngs_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = usual::elastic_modulus,
        .need = Need::required,
        .sentence = "Young's modulus."},
    Key{.name = "poisson_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 0.5, .high_open = true},
        .need = Need::required,
        .sentence = "Poisson's ratio."},
    Key{.name = "damping_ratio",
        .type = Type::number,
        .range = {.low = 0, .high = 2},
        .usual = usual::damping_ratio,
        .default_text = "0.0",
        .sentence = "Damping ratio at the frequencies f1 and f2 of [damping]."},
    Key{.name = "water_table",
        .type = Type::number,
        .unit = "m",
        .note = "default: no water in the pores",
        .sentence =
            "Elevation of the water table, y in 2-D and z in 3-D: below it the ground has saturated_density and a hydrostatic "
            "pore pressure, and its strength and stiffness are those of the effective stress."},
    Key{.name = "saturated_density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = usual::density,
        .note = "required with a water_table",
        .sentence = "Density of the ground below the water table, with the water in its pores."},
    Key{.name = "pore_water_density",
        .type = Type::number,
        .unit = "kg/m3",
        .range = positive,
        .usual = water_density,
        .default_text = "1000.0",
        .note = "only with a water_table",
        .sentence = "Density of the water in the pores."},
    Key{.name = "drainage",
        .type = Type::choice,
        .default_text = "\"drained\"",
        .note = "only with a water_table",
        .sentence = "drained: the pore pressure stays hydrostatic; undrained: the water moves with the ground, and its pressure "
                    "follows the volume; flow: it also flows through the pores (consolidation), with Darcy's law.",
        .choices = drainages},
    Key{.name = "porosity",
        .type = Type::number,
        .range = {.low = 0, .high = 1, .low_open = true, .high_open = true},
        .usual = {0.1, 0.7},
        .note = "required for drainage undrained and flow",
        .sentence = "Volume of the pores per volume of the ground."},
    Key{.name = "water_bulk_modulus",
        .type = Type::number,
        .unit = "Pa",
        .range = positive,
        .usual = {1e7, 3e9},
        .default_text = "2.2e9",
        .note = "drainage undrained and flow",
        .sentence = "Bulk modulus of the water in the pores; a little air lowers it much."},
    Key{.name = "hydraulic_conductivity",
        .type = Type::number,
        .unit = "m/s",
        .range = positive,
        .usual = {1e-12, 1},
        .note = "required for drainage flow",
        .sentence = "Coefficient of permeability k of Darcy's law, the velocity of flow under a gradient of 1: gravel some 1e-2, "
                    "sand 1e-4, silt 1e-6, clay below 1e-8 m/s."},
    Key{.name = "cohesion",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "default: the material is elastic and never yields",
        .sentence = "Cohesion of the Mohr-Coulomb strength."},
    Key{.name = "friction_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .usual = {usual::friction_angle.low, 60},
        .note = "required with a cohesion",
        .sentence = "Friction angle."},
    Key{.name = "dilation_angle",
        .type = Type::number,
        .unit = "deg",
        .range = {.low = 0, .high = 60},
        .default_text = "0.0",
        .note = with_strength,
        .sentence = "Dilation angle; at most the friction angle."},
    Key{.name = "tensile_strength",
        .type = Type::number,
        .unit = "Pa",
        .range = not_negative,
        .usual = usual::strength,
        .note = "only with a cohesion; default: cohesion/tan(friction_angle), without friction none",
        .sentence = "Tension cut-off: largest tensile stress; at most cohesion/tan(friction_angle)."},
    Key{.name = "blow_count",
        .type = Type::number,
        .range = {.low = 0, .high = 100, .low_open = true},
        .usual = {3, 50},
        .note = "with a cohesion; not with contraction_rate; default: cycles of shear take no volume",
        .sentence =
            "Sand that contracts under cycles of shear (Byrne 1991), by the blow count (N1)60 of the standard penetration "
            "test: contraction_rate = 8.7 (N1)60^-1.25."},
    Key{.name = "contraction_rate",
        .type = Type::number,
        .range = {.low = 0, .high = 10, .low_open = true},
        .usual = {0.01, 2},
        .note = "with a cohesion; not with blow_count",
        .sentence = "C1 of the contraction C1 g/2 exp(-C2 e/g) in a half cycle of shear strain g after a contraction e; C2 is "
                    "0.4/C1."},
    Key{.name = "contraction_threshold",
        .type = Type::number,
        .range = {.low = 0, .high = 0.1},
        .default_text = "1e-4",
        .note = "only with blow_count or contraction_rate",
        .sentence = "Amplitude of shear strain up to which a half cycle takes no volume."},
};

inline constexpr auto material_keys = joined(own_material_keys, soil_keys);

}  // namespace sazare::cases
