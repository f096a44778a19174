#include "sazare/methods/mps/degrading_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

namespace sazare::methods::mps {

template <int D>
DegradingGround<D>::DegradingGround(std::span<const DegradingSoil> soils, std::span<const Index> material,
                                    std::vector<Real> volume) {
  const auto degrades = [&](Index ground) { return ground >= 0 && !soils[at(ground)].parts.empty(); };
  if (std::ranges::none_of(material, degrades)) return;
  volume_ = std::move(volume);
  square_of_peak_.assign(volume_.size(), 0);
  const std::size_t packs = volume_.size() / lane_count;
  kind_.assign(packs, -1);
  begin_.assign(packs, 0);
  std::size_t rows = 0;
  for (std::size_t pack = 0; pack < packs; ++pack) {
    std::array<Index, lane_count> of_lanes;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t i = pack * lane_count + lane;
      of_lanes[lane] = i < material.size() && degrades(material[i]) ? material[i] : -1;
    }
    if (std::ranges::none_of(of_lanes, degrades)) continue;
    kind_[pack] = kind_of(soils, of_lanes);
    begin_[pack] = rows * lane_count;
    rows += Pack::rows(kinds_[at(kind_[pack])].parts.share.size());
  }
  memory_.assign(rows * lane_count, 0);
}

template <int D>
Index DegradingGround<D>::kind_of(std::span<const DegradingSoil> soils, const std::array<Index, lane_count>& material) {
  const auto found = std::ranges::find(kinds_, material, &Kind::material);
  if (found != kinds_.end()) return static_cast<Index>(found - kinds_.begin());
  Kind kind;
  kind.material = material;
  std::size_t most = 0;
  for (const Index ground : material)
    if (ground >= 0) most = std::max(most, soils[at(ground)].parts.size());
  kind.parts.share.assign(most, Lanes{});
  kind.parts.yield_strain.assign(most, broadcast(std::numeric_limits<Real>::infinity()));
  for (int lane = 0; lane < lane_count; ++lane) {
    const Index ground = material[static_cast<std::size_t>(lane)];
    if (ground < 0) continue;
    const auto& [elastic, parts] = soils[at(ground)];
    kind.is_soil[lane] = -1;
    kind.shear_modulus[lane] = elastic.shear_modulus;
    kind.poisson_ratio[lane] = 0.5 * elastic.lame / (elastic.lame + elastic.shear_modulus);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      kind.parts.share[i][lane] = parts[i].shear_modulus / elastic.shear_modulus;
      kind.parts.yield_strain[i][lane] = parts[i].yield_strain;
    }
  }
  kinds_.push_back(kind);
  return static_cast<Index>(kinds_.size()) - 1;
}

template <int D>
bool DegradingGround<D>::flow(std::size_t pack, const Tensor& strain, LaneMask spans, Real* slip, Tensor& grown) {
  const Kind& kind = kinds_[at(kind_[pack])];
  const LaneMask moves = spans & kind.is_soil;
  typename Pack::Deviator deviator, flow;
  if constexpr (D == 2) {
    const Lanes mean = (strain[0] + strain[3]) / 3;
    deviator = {strain[0] - mean, strain[3] - mean, strain[1] + strain[2]};
  } else {
    const Lanes mean = (strain[0] + strain[4] + strain[8]) / 3;
    deviator = {strain[0] - mean, strain[4] - mean, strain[1] + strain[3], strain[5] + strain[7], strain[2] + strain[6]};
  }
  Real* peak = &square_of_peak_[pack * lane_count];
  store_lanes(peak, maximum(load_lanes(peak), select(moves, Pack::square_of_shear(deviator), Lanes{})));
  if (!Pack::advance(kind.parts, deviator, moves, &memory_[begin_[pack]], flow)) return false;
  store_lanes(slip, load_lanes(slip) + square_root(Pack::square_of_shear(flow)));
  const Lanes across = -flow[0] - flow[1];
  if constexpr (D == 2) {
    const Lanes thinner = kind.poisson_ratio * across;
    grown = {flow[0] + thinner, 0.5 * flow[2], 0.5 * flow[2], flow[1] + thinner};
  } else {
    const Lanes xy = 0.5 * flow[2], yz = 0.5 * flow[3], zx = 0.5 * flow[4];
    grown = {flow[0], xy, zx, xy, flow[1], yz, zx, yz, across};
  }
  return true;
}

template <int D>
Real DegradingGround<D>::peak(Index particle) const {
  return std::sqrt(square_of_peak_[at(particle)]);
}

template <int D>
Real DegradingGround<D>::stored() const {
  Real total = 0;
  for (std::size_t pack = 0; pack < kind_.size(); ++pack) {
    if (!holds(pack)) continue;
    const Kind& kind = kinds_[at(kind_[pack])];
    Lanes energy = 0.5 * kind.shear_modulus * Pack::locked_in(kind.parts, &memory_[begin_[pack]]);
    if constexpr (D == 2) {
      const auto mean = Pack::mean_plastic(&memory_[begin_[pack]]);
      const Lanes across = mean[0] + mean[1];
      energy += kind.shear_modulus * (1 + kind.poisson_ratio) * across * across;  // E p_zz^2/2
    }
    energy *= load_lanes(&volume_[pack * lane_count]);
    for (int lane = 0; lane < lane_count; ++lane) total += energy[lane];
  }
  return total;
}

template <int D>
void DegradingGround<D>::columns(Archive& archive) {
  archive("memory", memory_);
  archive("square_of_peak", square_of_peak_);
}

template class DegradingGround<2>;
template class DegradingGround<3>;

}  // namespace sazare::methods::mps
