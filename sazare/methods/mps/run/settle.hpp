#pragma once

/// The equilibrium of ground under gravity, before a run begins.

#include <cstdint>
#include <functional>

#include "sazare/methods/mps/run/model.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// How near to rest: nearly while a surface still moves, in turns with what carries it.
enum class Rest { nearly, fully };

/// Finds it where the case asks for it; a surface that the ground meets stands still meanwhile. False when asked to stop before
/// it is reached. Throws PhysicsError where the ground slides, or does not come to rest. `is_enough`, where there is one, is
/// asked now and then with the steps so far whether what is reached is taken for rest.
template <int D>
bool settle(const cases::MpsCase& mps, MpsModel<D>& model, const RunOptions& options, Rest rest = Rest::fully,
            const std::function<bool(std::int64_t steps)>& is_enough = {});

extern template bool settle<2>(const cases::MpsCase&, MpsModel<2>&, const RunOptions&, Rest,
                               const std::function<bool(std::int64_t)>&);
extern template bool settle<3>(const cases::MpsCase&, MpsModel<3>&, const RunOptions&, Rest,
                               const std::function<bool(std::int64_t)>&);

}  // namespace sazare::runs
