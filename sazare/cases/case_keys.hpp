#pragma once

#include <array>

#include "sazare/cases/format/schema.hpp"
#include "sazare/cases/format/usual_values.hpp"

/// Keys and tables that the methods share.
namespace sazare::cases {

/// The choices of `method` are put in where the list of all methods is known (method_choice.hpp).
inline constexpr std::array case_keys{
    Key{.name = "title", .type = Type::text, .need = Need::required, .sentence = "What the case is called in reports."},
    Key{.name = "method", .type = Type::text, .need = Need::required, .sentence = "How the body is modelled."},
};

inline constexpr std::array<std::string_view, 4> motion_shapes{"ricker", "sine", "record", "function"};
inline constexpr std::array<std::string_view, 3> quantities{"displacement", "velocity", "acceleration"};
inline constexpr std::array<std::string_view, 3> baselines{"none", "constant", "linear"};

inline constexpr std::array motion_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name by which boundaries refer to it."},
    Key{.name = "type",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "A Ricker wavelet, a sine from t = 0, a record from a file, or a function that the caller gives in Python.",
        .choices = motion_shapes},
    Key{.name = "quantity",
        .type = Type::choice,
        .default_text = "\"acceleration\"",
        .note = "not for a record, whose file states it",
        .sentence =
            "What the formula describes; the other two follow by integration from rest or differentiation. Displacements "
            "count from where things stand at t = 0. After the end of a formula, a record or a function, what was given is "
            "the last displacement, no velocity or no acceleration; velocity that a record of accelerations leaves goes on.",
        .choices = quantities},
    Key{.name = "amplitude",
        .type = Type::number,
        .default_text = "1.0",
        .sentence = "Amplitude of the formula, in m, m/s or m/s2 according to the quantity, with which a wavelet has the value "
                    "-amplitude at its peak time; for a record or a function, a dimensionless factor."},
    Key{.name = "frequency",
        .type = Type::number,
        .unit = "Hz",
        .range = positive,
        .note = "required for a wavelet and a sine",
        .sentence = "Frequency of the sine, central frequency of the wavelet."},
    Key{.name = "peak_time",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .note = "required for a wavelet",
        .sentence = "Time of the wavelet's peak; at least 1/frequency, so that the wavelet begins at rest."},
    Key{.name = "cycles",
        .type = Type::number,
        .range = not_negative,
        .default_text = "0.0",
        .sentence = "Number of periods of the sine; 0: unlimited."},
    Key{.name = "file",
        .type = Type::file,
        .note = "required for a record",
        .sentence =
            "CSV with a header that states the unit, such as \"time [s],acceleration [gal]\" (m/s2, g, gal or cm/s2, m/s, cm/s, "
            "m, cm), PEER .AT2, or K-NET ASCII (.EW .NS .UD)."},
    Key{.name = "baseline",
        .type = Type::choice,
        .default_text = "\"none\"",
        .sentence =
            "Baseline correction: what is subtracted from a record so that its integral has no trend: nothing, a "
            "constant or a straight line. It is fitted to the whole record by least squares, so that a small velocity may "
            "be left at its end, which check tells.",
        .choices = baselines},
};

inline constexpr std::string_view geo_only = "only for a .geo file";

inline constexpr std::array mesh_keys{
    Key{.name = "file",
        .type = Type::file,
        .need = Need::required,
        .sentence = "Gmsh mesh (.msh, format 4.1) or geometry (.geo, meshed by gmsh when the case is run), relative "
                    "to the case file."},
    Key{.name = "scale",
        .type = Type::number,
        .range = positive,
        .default_text = "1.0",
        .sentence = "Factor on all coordinates, such as 0.001 for a mesh in millimetres."},
    Key{.name = "size_factor",
        .type = Type::number,
        .range = positive,
        .default_text = "1.0",
        .note = geo_only,
        .sentence = "Factor on all element sizes (gmsh -clscale)."},
    Key{.name = "parameters",
        .type = Type::numbers,
        .default_text = "{}",
        .note = geo_only,
        .sentence = "Values for constants that the geometry declares with DefineConstant (gmsh -setnumber)."},
};

inline constexpr std::array damping_keys{
    Key{.name = "f1",
        .type = Type::number,
        .unit = "Hz",
        .range = positive,
        .note = "required where a material has a damping_ratio",
        .sentence = "Lower frequency at which the damping ratio equals that of the material."},
    Key{.name = "f2",
        .type = Type::number,
        .unit = "Hz",
        .range = positive,
        .note = "required where a material has a damping_ratio",
        .sentence = "Higher frequency at which the damping ratio equals that of the material."},
    Key{.name = "relative_to_base",
        .type = Type::boolean,
        .default_text = "true",
        .sentence =
            "Mass-proportional damping acts on the velocity relative to the base along an axis along which all supports follow "
            "one prescribed motion; elsewhere, and with false, on the velocity in space."},
};

inline constexpr std::array gravity_keys{
    Key{.name = "acceleration",
        .type = Type::vector,
        .unit = "m/s2",
        .usual = usual::gravity,
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Gravitational acceleration."},
};

inline constexpr std::array output_keys{
    Key{.name = "checkpoint_interval",
        .type = Type::number,
        .unit = "s",
        .range = positive,
        .default_text = "60.0",
        .sentence = "Wall-clock time between checkpoints."},
};

inline constexpr Key end_key{
    .name = "end",
    .type = Type::number,
    .unit = "s",
    .range = positive,
    .need = Need::required,
    .sentence = "Time at which the run ends; it begins at 0.",
};

inline constexpr Range stability_fraction_range{.low = 0, .high = 1, .low_open = true, .high_open = true};

inline constexpr Key strict_key{
    .name = "strict",
    .type = Type::boolean,
    .default_text = "false",
    .sentence = "Treat warnings as errors.",
};

inline constexpr Key gauge_name_key{
    .name = "name",
    .type = Type::text,
    .need = Need::required,
    .sentence = "Name of the gauge; its columns in gauges.csv begin with it.",
};

inline constexpr Key history_interval_key{
    .name = "history_interval",
    .type = Type::number,
    .unit = "s",
    .range = positive,
    .note = "default: about end/200",
    .sentence = "Time between rows of the histories; the end is a whole multiple of it.",
};

inline constexpr Key snapshot_interval_key{
    .name = "snapshot_interval",
    .type = Type::number,
    .unit = "s",
    .range = positive,
    .note = "default: about end/20",
    .sentence = "Time between snapshots; a whole multiple of history_interval, of which the end is a whole multiple.",
};

inline constexpr Table case_table{"case", false, Need::required, "Title and method of the case.", case_keys};
inline constexpr Table motions_table{"motions", true, Need::optional,
                                     "Ground motions: wavelets, sines, records and functions of time.", motion_keys};
inline constexpr Table gravity_table{"gravity", false, Need::optional, "Body force.", gravity_keys};
inline constexpr Table output_table{"output", false, Need::optional, "What is written besides histories and snapshots.",
                                    output_keys};

}  // namespace sazare::cases
