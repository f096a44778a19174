#pragma once

/// What quantities of the field usually are, from soft soil to steel and from laboratory specimens to quarries. Values outside
/// are more often slips of units than meant, so they are warned about.

#include "sazare/cases/format/document.hpp"
#include "sazare/cases/format/problems.hpp"
#include "sazare/cases/format/schema.hpp"

namespace sazare::cases {

namespace usual {

inline constexpr UsualRange density{100, 25e3};             // [kg/m3]
inline constexpr UsualRange elastic_modulus{2e5, 2e12};     // [Pa]
inline constexpr UsualRange rock_modulus{1e7, 2e12};        // [Pa]
inline constexpr UsualRange strength{100, 10e9};            // [Pa]
inline constexpr UsualRange stiffness_per_area{1e5, 1e16};  // [Pa/m]
inline constexpr UsualRange contact_stiffness{1e3, 1e15};   // of blocks [N/m]
inline constexpr UsualRange spring_modulus{1e4, 1e13};      // of squares [Pa]
inline constexpr UsualRange gravity{0, 500};                // up to that in centrifuges [m/s2]
inline constexpr UsualRange fracture_energy{1e-3, 1e6};     // [N/m]
inline constexpr UsualRange blast_pressure{1e4, 200e9};     // [Pa]
inline constexpr UsualRange damping_ratio{0, 1};
inline constexpr UsualRange weibull_modulus{1.5, 60};
inline constexpr UsualRange friction_angle{2, 80};    // [deg]
inline constexpr UsualRange reference_strain{1e-5, 0.1};
inline constexpr UsualRange wave_velocity{10, 15e3};  // [m/s]
inline constexpr UsualRange delay{0, 30};             // of a blast [s]
inline constexpr UsualRange rise_time{0, 0.1};        // of its pressure [s]
inline constexpr UsualRange explosive_density{300, 2200};     // [kg/m3]
inline constexpr UsualRange detonation_velocity{1000, 10e3};  // [m/s]
inline constexpr UsualRange crack_aperture{1e-6, 1e-3};       // [m]
inline constexpr UsualRange explosive_energy{0.5e6, 10e6};    // [J/kg]
inline constexpr UsualRange hole_diameter{1e-3, 2};           // [m]
inline constexpr UsualRange section_area{1e-6, 20};           // [m2]
inline constexpr UsualRange second_moment{1e-12, 100};        // [m4]
inline constexpr UsualRange member_force{200, 1e9};           // and moment of a member at yield [N, N m]

}  // namespace usual

/// Warns of a number outside the usual range of its key, and says which unit would explain it. False for one so far above it that
/// nothing can be computed with it, which is an error.
bool warn_of_unusual(const Key& key, const Value& value, Real number, Problems& problems);

}  // namespace sazare::cases
