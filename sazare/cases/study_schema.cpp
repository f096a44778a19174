#include <array>

#include "sazare/cases/study_file.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 2> sought{"time_step", "factor_of_safety"};

constexpr std::array study_keys{
    Key{.name = "title", .type = Type::text, .need = Need::required, .sentence = "Title of the study in reports."},
    Key{.name = "find",
        .type = Type::choice,
        .default_text = "\"time_step\"",
        .sentence =
            "What is sought in each case: the largest stable time step, or the factor of safety by strength reduction. A case "
            "whose method cannot do it is refused.",
        .choices = sought},
};

constexpr std::array family_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the family in results."},
    Key{.name = "case",
        .type = Type::file,
        .need = Need::required,
        .sentence = "Case file that the family varies, relative to the study file."},
};

constexpr std::array parameter_keys{
    Key{.name = "name", .type = Type::text, .need = Need::required, .sentence = "Name of the parameter in results."},
    Key{.name = "unit", .type = Type::text, .default_text = "\"-\"", .sentence = "Its unit in results."},
    Key{.name = "keys",
        .type = Type::names,
        .need = Need::required,
        .sentence = "Key of the case that it sets, as for --set; one for all families, or one for each in their order."},
    Key{.name = "values", .type = Type::values, .need = Need::required, .sentence = "Values that it takes."},
};

constexpr std::array limit_keys{
    Key{.name = "ratio",
        .type = Type::number,
        .range = {.low = 1, .high = 10, .low_open = true},
        .default_text = "1.01",
        .sentence = "Ratio of the smallest unstable step to the largest stable one at which the bisection ends."},
    Key{.name = "steps",
        .type = Type::integer,
        .range = {.low = 0, .high = 1e9},
        .default_text = "4000",
        .sentence = "Steps of a trial; 0: to the end of the case."},
    Key{.name = "divergence",
        .type = Type::number,
        .unit = "m/s2",
        .range = positive,
        .default_text = "1e15",
        .sentence = "Acceleration above which a trial is taken to have diverged."},
};

constexpr std::array factor_keys{
    Key{.name = "lower",
        .type = Type::number,
        .range = positive,
        .default_text = "0.5",
        .sentence = "Factor at which the ground stands. Strengths are divided by factors: below 1 the ground is stronger than in "
                    "its case. Where it fails already, or stands at the upper one still, the factor of the case is nan."},
    Key{.name = "upper",
        .type = Type::number,
        .range = positive,
        .default_text = "4.0",
        .sentence = "Factor at which the ground fails."},
    Key{.name = "ratio",
        .type = Type::number,
        .range = {.low = 1, .high = 10, .low_open = true},
        .default_text = "1.01",
        .sentence = "Ratio of the smallest factor with which the ground fails to the largest with which it stands at which the "
                    "bisection ends."},
    Key{.name = "displacement_ratio",
        .type = Type::number,
        .range = {.low = 1, .high = 1000, .low_open = true},
        .note = "default: that of the method",
        .sentence =
            "The ground has failed where it finds no equilibrium under gravity, or where the largest displacement is more "
            "than so many times that of the same ground without a limit of strength."},
};

constexpr std::array tables{
    Table{"study", false, Need::required, "Title of the study, and what it seeks.", study_keys},
    Table{"families", true, Need::required, "Cases that are varied.", family_keys},
    Table{"parameters", true, Need::optional, "Parameters that are varied: all combinations are run.", parameter_keys},
    Table{"limit", false, Need::optional, "How the stability limit is found by bisection.", limit_keys},
    Table{"factor", false, Need::optional, "How the factor of safety is found by bisection.", factor_keys},
};

}  // namespace

std::span<const Table> study_schema() { return tables; }

}  // namespace sazare::cases
