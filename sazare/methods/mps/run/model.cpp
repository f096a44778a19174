#include "sazare/methods/mps/run/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/mps/elastic_forces.hpp"
#include "sazare/methods/mps/run/coarse_slopes.hpp"
#include "sazare/methods/mps/run/loose_parts.hpp"
#include "sazare/methods/mps/run/side_columns.hpp"
#include "sazare/methods/mps/run/supports.hpp"

namespace sazare::runs {

namespace {

using methods::mps::Site;

constexpr Real near_limit = 0.98;  // of the limit; above it a run is stable, but barely

template <int D>
state::Particles<D> make_particles(const cases::MpsCase& mps, const Filling<D>& filling, const std::vector<Index>& material) {
  state::Particles<D> particles;
  particles.spacing = filling.spacing;
  particles.resize(static_cast<Index>(filling.sites.size()));
  for (std::size_t i = 0; i < filling.sites.size(); ++i) {
    const cases::Ground& ground = mps.materials[static_cast<std::size_t>(material[i])];
    const Vector<D> place = filling.place(i);
    for (std::size_t axis = 0; axis < D; ++axis) particles.start[axis][i] = place[static_cast<int>(axis)];
    particles.set_density(static_cast<Index>(i), ground.density);
    particles.shear_modulus[i] = ground.density * ground.s_wave_velocity * ground.s_wave_velocity;
    particles.lame[i] = ground.density * ground.p_wave_velocity * ground.p_wave_velocity - 2 * particles.shear_modulus[i];
    particles.damping_ratio[i] = ground.damping_ratio;
  }
  return particles;
}

std::vector<laws::OverlayPart> parts_of(const cases::Ground& ground) {
  if (!ground.degrades) return {};
  return laws::OverlayModel<4>({ground.shear_modulus(), 0}, cases::backbone_of(ground, ground.shear_modulus())).parts();
}

methods::mps::StrengthOfGround strength_of(const cases::Ground& ground, const SofteningPlace& place) {
  const Real mu = ground.shear_modulus();
  return {ground.yields,
          peak_strength(ground),
          {mu, ground.density * ground.p_wave_velocity * ground.p_wave_velocity - 2 * mu},
          ground.density,
          ground.rupture_strain,
          parts_of(ground),
          softening_of(ground, place)};
}

/// Adds random velocities, which do not depend on the number of threads.
template <int D>
void add_noise(const cases::Noise& noise, state::Particles<D>& particles) {
  auto state = static_cast<std::uint64_t>(noise.seed) * 0x9E3779B97F4A7C15ULL;
  for (std::size_t freedom = 0; freedom < particles.velocity.size(); ++freedom)
    for (std::size_t i = 0; i < particles.size(); ++i) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      const Real share = static_cast<Real>(state >> 11) / 4503599627370496.0 - 1;
      particles.velocity[freedom][i] = share * noise.velocity * (freedom < D ? 1 : 2 / particles.spacing);
    }
}

/// Length of the body along the periodic axes, in spacings.
template <int D>
Site<D> period_of(const cases::MpsCase& mps, const Filling<D>& filling) {
  Site<D> period{};
  for (const Site<D>& site : filling.sites)
    for (std::size_t axis = 0; axis < D; ++axis)
      if (mps.particles.periodic[axis]) period[axis] = std::max(period[axis], site[axis] + 1);
  return period;
}

/// Refuses a case from whose numbers no limit follows.
void check_limit(const cases::CaseFile& file, Real limit) {
  if (std::isnan(limit))
    refuse(file, "materials",
           "no stability limit follows from the materials and the spacing: a frequency of the ground is not a number",
           "one of density, wave velocities, damping and spacing is too large or too small to be meant so: check their units");
}

/// The step of a run, which divides the history interval, or the shorter windows of a coupling.
template <int D>
Real choose_step(const cases::CaseFile& file, const MpsModel<D>& model, const std::optional<MpsCoupling>& coupling) {
  const cases::MpsTime& time = file.as<cases::MpsCase>().time;
  const Real limit = model.stable_step(time);
  check_limit(file, limit);
  if (time.step) return *time.step;
  if (!(limit > 0))
    refuse(file, "time.integrator", "Euler's step without damping is never stable, so no step can be chosen",
           "give a step, use integrator \"verlet\", or give every material a damping_ratio");
  const Real interval = coupling ? coupling->window : time.history_interval;
  return interval / std::ceil(interval / (time.stability_fraction * limit));
}

/// Refuses a step above the limit, and warns of one that is close to it.
template <int D>
std::string check_step(const cases::CaseFile& file, const MpsModel<D>& model) {
  const cases::MpsTime& time = file.as<cases::MpsCase>().time;
  const Real limit = model.stable_step(time);
  const std::string what =
      fmt::format("the step of {} s is {} times the predicted limit of {} s", cases::short_number(model.step, 4),
                  cases::short_number(model.step / limit, 4), cases::short_number(limit, 4));
  const bool euler = time.integrator == cases::Integrator::euler;
  if (!(limit > 0)) {
    const std::string never = "Euler's step without damping is never stable";
    const std::string help = "short runs may tolerate it; use integrator \"verlet\", or give every material a damping_ratio";
    if (time.strict) refuse(file, "time.integrator", never, help);
    return warning(file, "time.integrator", never, help);
  }
  if (model.step > limit && !(euler && !time.strict))
    refuse(file, "time.step", what, fmt::format("choose {} s or less, or give no step", cases::short_number(0.9 * limit, 3)));
  if (model.step > limit)
    return warning(
        file, "time.step", what,
        "the error of Euler's step then grows slowly: short runs may tolerate it; the limit of Verlet's step is larger");
  if (model.step > near_limit * limit) return warning(file, "time.step", what, "0.9 of it leaves a margin for large motion");
  return {};
}

}  // namespace

std::vector<methods::mps::StrengthOfGround> strengths_of(const cases::MpsCase& mps, const SofteningPlace& place) {
  std::vector<methods::mps::StrengthOfGround> grounds;
  for (const cases::Ground& ground : mps.materials) grounds.push_back(strength_of(ground, place));
  return grounds;
}

template <int D>
MpsParts<D> lay_out(const cases::MpsCase& mps, Filling<D> filling, const Site<D>& period) {
  MpsParts<D> parts;
  parts.filling = std::move(filling);
  parts.period = period;
  for (const Index region : parts.filling.region) {
    const std::string& name = mps.regions[static_cast<std::size_t>(region)].name;
    const auto made_of = std::ranges::find_if(mps.materials, [&](const cases::Ground& ground) {
      return std::ranges::find(ground.regions, name) != ground.regions.end();
    });
    parts.material.push_back(static_cast<Index>(made_of - mps.materials.begin()));
  }
  parts.particles = make_particles<D>(mps, parts.filling, parts.material);
  if (mps.particles.rotation_torque == cases::RotationTorque::whole)  // twice the torque turns as half the inertia does
    for (Real& inverse : parts.particles.inverse_inertia) inverse *= 2;
  parts.links = methods::mps::make_links<D>(parts.filling.sites, mps.particles.spacing, mps.particles.influence, period);
  if (mps.damping.f2 > 0) parts.damping = laws::RayleighDamping::make(mps.damping.f1, mps.damping.f2);
  return parts;
}

template <int D>
MpsParts<D> make_parts(const cases::CaseFile& file) {
  const cases::MpsCase& mps = file.as<cases::MpsCase>();
  const Filling<D> filling = fill_regions<D>(file);
  MpsParts<D> parts = lay_out<D>(mps, filling, period_of<D>(mps, filling));
  if (mps.noise.velocity > 0) add_noise<D>(mps.noise, parts.particles);
  const Members members = members_of<D>(mps, parts.filling);
  add_supports<D>(mps, members, parts);
  parts.sides = words_of_sides<D>(mps, members, parts.filling);
  return parts;
}

template <int D>
std::unique_ptr<particles::ParticleForces<D>> MpsParts<D>::forces(const cases::MpsCase& mps, Real step) const {
  if (std::ranges::none_of(mps.materials, [](const cases::Ground& ground) { return ground.fails(); }))
    return std::make_unique<methods::mps::ElasticForces<D>>(links,
                                                            static_cast<methods::mps::RotationRemoval>(mps.particles.rotation));
  methods::mps::LooseRules rules{.step = step, .damping_ratio = mps.contact.damping_ratio, .period = {}};
  for (std::size_t axis = 0; axis < D; ++axis) rules.period[axis] = period[axis] * particles.spacing;
  return std::make_unique<methods::mps::FailingForces<D>>(
      particles, links,
      methods::mps::GroundStrength<D>(particles, links, strengths_of(mps, softening_place<D>(mps, links, filling, material)),
                                      material),
      rules);
}

template <int D>
std::unique_ptr<particles::UniformStepper<D>> MpsParts<D>::stepper(const cases::MpsCase& mps, Real step,
                                                                   std::unique_ptr<particles::ParticleForces<D>> forces) const {
  auto integrator = static_cast<particles::Integrator>(mps.time.integrator);
  if (integrator == particles::Integrator::euler && mps.time.euler_damping == cases::EulerDamping::lagged)
    integrator = particles::Integrator::euler_lagged;
  const particles::UniformRules rules{step, integrator, damping};
  return std::make_unique<particles::UniformStepper<D>>(particles, std::move(forces), supports, rules);
}

namespace {

/// Of the ground by particle.
std::vector<methods::mps::WaveVelocities> wave_velocities(const cases::MpsCase& mps, const std::vector<Index>& material) {
  std::vector<methods::mps::WaveVelocities> waves;
  for (const Index number : material) {
    const cases::Ground& ground = mps.materials[static_cast<std::size_t>(number)];
    waves.push_back({ground.p_wave_velocity, ground.s_wave_velocity});
  }
  return waves;
}

/// What the contacts with a surface give a particle at most over its mass, where it lies between two faces [1/s2].
Real square_of_contacts(const std::vector<methods::mps::WaveVelocities>& waves, Real spacing) {
  return 2 * methods::mps::stiffness_over_mass(std::ranges::max_element(waves, {}, &methods::mps::WaveVelocities::p)->p, spacing);
}

}  // namespace

template <int D>
MpsModel<D> build_mps(const cases::CaseFile& file, const std::optional<MpsCoupling>& coupling) {
  const auto& mps = file.as<cases::MpsCase>();
  const MpsParts<D> parts = make_parts<D>(file);
  const SofteningPlace softening = softening_place<D>(mps, parts.links, parts.filling, parts.material);
  check_softening(file, softening);
  const SideParts<D> beside = make_side_parts<D>(file, parts);
  MpsModel<D> model;
  model.limit = beside.predict(parts.predict());
  const std::vector<methods::mps::WaveVelocities> waves = wave_velocities(mps, parts.material);
  if (coupling) model.limit = methods::mps::with_outside_springs(model.limit, square_of_contacts(waves, parts.particles.spacing));
  model.number_density = parts.links.number_density;
  model.filling = parts.filling;
  model.material = parts.material;
  model.sides = parts.sides;
  model.step = choose_step<D>(file, model, coupling);
  model.warning = check_step<D>(file, model) + warn_of_coarse_slopes<D>(file, parts.filling) + warn_of_softening(file, softening);
  if (!coupling) model.warning += warn_of_loose_parts<D>(file, parts);  // else the surface may hold them
  std::unique_ptr<particles::ParticleForces<D>> forces = parts.forces(mps, model.step);
  model.failing = dynamic_cast<const methods::mps::FailingForces<D>*>(forces.get());
  if (const auto* elastic = dynamic_cast<const methods::mps::ElasticForces<D>*>(forces.get()))
    model.links = &elastic->links();
  else
    model.links = &model.failing->links();
  if (coupling) {
    const methods::mps::SurfaceRules rules{model.step, mps.contact.damping_ratio, coupling->friction};
    auto at_surface = std::make_unique<methods::mps::GroundAtSurface<D>>(std::move(forces), model.failing, waves, rules);
    model.at_surface = at_surface.get();
    forces = std::move(at_surface);
  }
  if (!beside.columns.empty()) {
    auto between = std::make_unique<methods::mps::FreeFieldForces<D>>(std::move(forces), beside.stand(mps, model.step));
    model.free_field = between.get();
    forces = std::move(between);
  }
  model.stepper = parts.stepper(mps, model.step, std::move(forces));
  return model;
}

template struct MpsParts<2>;
template struct MpsParts<3>;
template MpsParts<2> lay_out<2>(const cases::MpsCase&, Filling<2>, const Site<2>&);
template MpsParts<3> lay_out<3>(const cases::MpsCase&, Filling<3>, const Site<3>&);
template MpsParts<2> make_parts<2>(const cases::CaseFile&);
template MpsParts<3> make_parts<3>(const cases::CaseFile&);
template MpsModel<2> build_mps<2>(const cases::CaseFile&, const std::optional<MpsCoupling>&);
template MpsModel<3> build_mps<3>(const cases::CaseFile&, const std::optional<MpsCoupling>&);

}  // namespace sazare::runs
