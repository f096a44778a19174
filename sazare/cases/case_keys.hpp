#pragma once

#include <array>

#include "sazare/cases/schema.hpp"

/// Keys and tables that the methods share.
namespace sazare::cases {

inline constexpr std::array<std::string_view, 2> method_names{"blocks", "mps"};

inline constexpr std::array case_keys{
    Key{.name = "title",
        .type = Type::text,
        .need = Need::required,
        .sentence = "What the case is called in reports."},
    Key{.name = "method",
        .type = Type::choice,
        .need = Need::required,
        .sentence = "How the body is modelled: blocks are bonded tetrahedra that can break apart, mps are moving particles of an "
                    "elastic ground in an earthquake.",
        .choices = method_names},
};

inline constexpr std::array gravity_keys{
    Key{.name = "acceleration",
        .type = Type::vector,
        .unit = "m/s2",
        .default_text = "[0.0, 0.0, 0.0]",
        .sentence = "Acceleration of free fall."},
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
    .sentence = "Time between snapshots; a whole multiple of history_interval, and the end one of it.",
};

inline constexpr Table case_table{"case", false, Need::required, "What the case is.", case_keys};
inline constexpr Table gravity_table{"gravity", false, Need::optional, "Body force.", gravity_keys};
inline constexpr Table output_table{"output", false, Need::optional, "What is written besides histories and snapshots.",
                                    output_keys};

}  // namespace sazare::cases
