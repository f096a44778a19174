#pragma once

/// The overlay model (overlay_plasticity.hpp) of several points at a time, in small steps: only those parts are looked at that
/// yield, or may.
///
/// A part whose strain e' - p_i lies within its yield strain g_i by a slack s_i cannot yield before e' has moved by s_i, since
/// |x| is a norm. So the least slack of some parts stands for all of them until e' has moved as far from where it was found; the
/// result is that of looking at every part. Parts stand in order of their yield strains: those that yield are mostly the first
/// ones, and the next to yield are those behind them. So there are three kinds: the first ones are looked at in every step; a few
/// next ones, the near ones, have a slack of their own, and all others, the far ones, have one.
///
/// Strains are deviators: xx, yy, xy in plane strain, in space also yz, zx; shear strains are engineering ones, zz = -(xx + yy).

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "sazare/core/lane_math.hpp"

namespace sazare::laws {

/// Parts of the soils of a pack, by lane; a lane without soil has parts of no stiffness that never yield.
struct PartsOfPack {
  std::vector<Lanes> share;         ///< G_i/G0 [-]
  std::vector<Lanes> yield_strain;  ///< g_i [-]
};

template <int D>
class OverlayPack {
public:
  static constexpr std::size_t numbers = D == 2 ? 3 : 5;
  using Deviator = std::array<Lanes, numbers>;

  /// Rows of `lane_count` numbers that a pack remembers, all 0 at the beginning: the near and the far slack and the strains at
  /// which they were found, how many parts are the first ones and how many these and the near ones, the mean plastic strain by
  /// stiffness, and the plastic strain of each part.
  static std::size_t rows(std::size_t parts) { return first_part + parts * numbers; }

  static Lanes square_of_shear(const Deviator& x) {
    Lanes sum = 4 * (x[0] * x[0] + x[1] * x[1] + x[0] * x[1]);
    for (std::size_t k = 2; k < numbers; ++k) sum += x[k] * x[k];
    return sum;
  }

  static Deviator mean_plastic(const Real* memory) { return read(memory, mean_row); }
  static Deviator plastic(const Real* memory, std::size_t part) { return read(memory, first_part + part * numbers); }

  /// Takes the pack to a strain, in the lanes that `moves` marks. Whether a part has yielded; `flow` is then left with what the
  /// mean plastic strain has grown by.
  static bool advance(const PartsOfPack& parts, const Deviator& strain, LaneMask moves, Real* memory, Deviator& flow) {
    flow = {};
    bool any_yields = false;
    if (is_beyond(memory, far_row, strain, moves)) {
      any_yields = look_at_all(parts, strain, moves, memory, flow);
    } else if (is_beyond(memory, near_row, strain, moves)) {
      any_yields = look_at_near(parts, strain, moves, memory, flow);
    } else {
      const std::size_t first = count(memory, first_row);
      for (std::size_t i = 0; i < first; ++i) any_yields |= yield(parts, i, strain, moves, memory, flow)[0] < 0;
    }
    if (any_yields) write(memory, mean_row, sum(read(memory, mean_row), flow));
    return any_yields;
  }

  /// Sum of share |p_i - p|^2 with their mean p: what stress has been locked in, over half of G0 [-].
  static Lanes locked_in(const PartsOfPack& parts, const Real* memory) {
    const Deviator mean = mean_plastic(memory);
    Lanes total{};
    for (std::size_t i = 0; i < parts.share.size(); ++i)
      total += parts.share[i] * square_of_shear(difference(plastic(memory, i), mean));
    return total;
  }

private:
  static constexpr std::size_t near_row = 0, far_row = 1 + numbers, first_row = 2 + 2 * numbers, near_end_row = first_row + 1,
                               mean_row = near_end_row + 1, first_part = mean_row + numbers;
  static constexpr std::size_t near_parts = 4;

  static std::size_t count(const Real* memory, std::size_t row) { return static_cast<std::size_t>(memory[row * lane_count]); }
  static void set_count(Real* memory, std::size_t row, std::size_t number) {
    store_lanes(memory + row * lane_count, broadcast(static_cast<Real>(number)));
  }
  static bool is_beyond(const Real* memory, std::size_t row, const Deviator& strain, LaneMask moves) {
    const Lanes slack = load_lanes(memory + row * lane_count);
    return any((square_of_shear(difference(strain, read(memory, row + 1))) > slack * slack) & moves);
  }
  static void set_slack(Real* memory, std::size_t row, const Deviator& strain, LaneMask moves, Lanes slack) {
    store_lanes(memory + row * lane_count, select(moves, maximum(slack, Lanes{}), Lanes{}));
    write(memory, row + 1, strain);
  }

  static Deviator read(const Real* memory, std::size_t row) {
    Deviator x;
    for (std::size_t k = 0; k < numbers; ++k) x[k] = load_lanes(memory + (row + k) * lane_count);
    return x;
  }
  static void write(Real* memory, std::size_t row, const Deviator& x) {
    for (std::size_t k = 0; k < numbers; ++k) store_lanes(memory + (row + k) * lane_count, x[k]);
  }
  static Deviator difference(const Deviator& a, const Deviator& b) {
    Deviator x;
    for (std::size_t k = 0; k < numbers; ++k) x[k] = a[k] - b[k];
    return x;
  }
  static Deviator sum(const Deviator& a, const Deviator& b) {
    Deviator x;
    for (std::size_t k = 0; k < numbers; ++k) x[k] = a[k] + b[k];
    return x;
  }

  /// Radial return of a part; `flow` grows by its share. What it could still move by [-]; below 0 in a lane that has yielded.
  static Lanes yield(const PartsOfPack& parts, std::size_t part, const Deviator& strain, LaneMask moves, Real* memory,
                     Deviator& flow) {
    const Deviator old = plastic(memory, part), trial = difference(strain, old);
    const Lanes most = parts.yield_strain[part], square = square_of_shear(trial);
    const LaneMask beyond = (square > most * most) & moves;
    if (!any(beyond)) return most - square_root(square);
    const Lanes lost = select(beyond, 1 - most * inverse_square_root(square), Lanes{});
    Deviator now;
    for (std::size_t k = 0; k < numbers; ++k) {
      const Lanes change = lost * trial[k];
      now[k] = old[k] + change;
      flow[k] += parts.share[part] * change;
    }
    write(memory, first_part + part * numbers, now);
    return broadcast(-1);
  }

  static bool look_at_near(const PartsOfPack& parts, const Deviator& strain, LaneMask moves, Real* memory, Deviator& flow) {
    const Lanes endless = broadcast(std::numeric_limits<Real>::infinity());
    Lanes least = endless;
    std::size_t first = 0;
    const std::size_t end = count(memory, near_end_row);
    for (std::size_t i = 0; i < end; ++i) {
      const Lanes slack = yield(parts, i, strain, moves, memory, flow);
      if (slack[0] < 0) first = i + 1;
      least = slack[0] < 0 ? endless : minimum(least, slack);
    }
    // Where all near parts yield, none is left that would tell when the far ones may.
    set_slack(memory, near_row, strain, moves, first < end ? least : Lanes{});
    if (first == end) set_slack(memory, far_row, strain, moves, Lanes{});
    set_count(memory, first_row, first);
    return first > 0;
  }

  /// From the last part on, so that the far ones are known when the first that yields is found.
  static bool look_at_all(const PartsOfPack& parts, const Deviator& strain, LaneMask moves, Real* memory, Deviator& flow) {
    const Lanes endless = broadcast(std::numeric_limits<Real>::infinity());
    std::array<Lanes, near_parts> last;  // slacks of the parts before which no other has been looked at
    last.fill(endless);
    Lanes far = endless;
    std::size_t first = 0;
    for (std::size_t i = parts.share.size(); i-- > 0;) {
      const Lanes slack = yield(parts, i, strain, moves, memory, flow);
      if (first > 0) continue;
      if (slack[0] < 0) {
        first = i + 1;
      } else {
        far = minimum(far, std::exchange(last[i % near_parts], slack));
      }
    }
    Lanes near = endless;
    for (const Lanes& slack : last) near = minimum(near, slack);
    set_slack(memory, near_row, strain, moves, near);
    set_slack(memory, far_row, strain, moves, far);
    set_count(memory, first_row, first);
    set_count(memory, near_end_row, std::min(first + near_parts, parts.share.size()));
    return first > 0;
  }
};

}  // namespace sazare::laws
