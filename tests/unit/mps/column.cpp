#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {

template <int D>
std::vector<Site<D>> box_sites(const Site<D>& counts) {
  std::vector<Site<D>> sites = {Site<D>{}};
  for (std::size_t axis = 0; axis < D; ++axis) {
    std::vector<Site<D>> longer;
    for (const Site<D>& site : sites)
      for (int i = 0; i < counts[axis]; ++i) {
        longer.push_back(site);
        longer.back()[axis] = i;
      }
    sites = longer;
  }
  return sites;
}

template <int D>
state::Particles<D> make_particles(const std::vector<Site<D>>& sites, Real spacing, const Soil& soil) {
  state::Particles<D> particles;
  particles.spacing = spacing;
  particles.resize(static_cast<Index>(sites.size()));
  const Real mu = soil.density * soil.s_wave_velocity * soil.s_wave_velocity;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t axis = 0; axis < D; ++axis) particles.start[axis][i] = (sites[i][axis] + 0.5) * spacing;
    particles.set_density(static_cast<Index>(i), soil.density);
    particles.shear_modulus[i] = mu;
    particles.lame[i] = soil.density * soil.p_wave_velocity * soil.p_wave_velocity - 2 * mu;
    particles.damping_ratio[i] = soil.damping_ratio;
  }
  return particles;
}

Column2::Column2(int across, int high, Real spacing, const Soil& soil)
    : sites(box_sites<2>({across, high})),
      particles(make_particles<2>(sites, spacing, soil)),
      links(make_links<2>(sites, spacing, 1.5)) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto particle = static_cast<Index>(i);
    if (sites[i][1] == 0) supports.held.push_back({particle, 0});
    if (sites[i][1] == 0 || sites[i][0] == 0 || sites[i][0] == across - 1) supports.held.push_back({particle, 1});
  }
}

template std::vector<Site<2>> box_sites<2>(const Site<2>&);
template std::vector<Site<3>> box_sites<3>(const Site<3>&);
template state::Particles<2> make_particles<2>(const std::vector<Site<2>>&, Real, const Soil&);
template state::Particles<3> make_particles<3>(const std::vector<Site<3>>&, Real, const Soil&);

}  // namespace sazare::methods::mps
