#include "tests/support/two_sides.hpp"

#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::test {

namespace {

namespace fem = methods::fem;

std::unique_ptr<methods::spheres::SphereStepper> make_balls(const CouplingScene& scene, Real step) {
  constexpr Real volume_of_unit = 4.18879020478639098462;
  state::Spheres spheres;
  for (const Ball& ball : scene.balls) {
    spheres.add(ball.centre, scene.radius, scene.ball_mass / (volume_of_unit * std::pow(scene.radius, 3)), 0);
    spheres.set_motion(spheres.size() - 1, ball.velocity, ball.spin);
  }
  methods::spheres::ContactTable table(laws::ContactModel::linear, 1);
  table.set(0, 0,
            laws::linear_constants(scene.stiffness, 0.8 * scene.stiffness, scene.restitution, {scene.friction, scene.rolling}));
  return std::make_unique<methods::spheres::SphereStepper>(
      std::move(spheres), table, std::vector<methods::spheres::Wall>{},
      methods::spheres::SphereRules{step, scene.gravity, 0.1 * scene.radius, 0.5 * scene.radius});
}

}  // namespace

template <int D>
std::unique_ptr<methods::fem::FemStepper<D>> make_fem(const CouplingScene& scene, Real window) {
  const ElementMesh mesh = box(scene.shape, scene.box);
  fem::Supports<D> supports;
  for (int axis = 0; axis < D; ++axis) {
    if (scene.held) hold<D>(mesh, "bottom", axis, supports);
    for (std::size_t node = 0; scene.upright && axis < D - 1 && node < mesh.nodes.size(); ++node)
      supports.held.push_back({static_cast<Index>(node), axis, fem::Support::no_motion, 0});
  }
  auto body = of_one_material(mesh, fem::SolidMaterial::elastic_of(scene.youngs_modulus, 0, scene.density));
  body.mass = scene.lumped ? fem::MassMatrix::lumped : fem::MassMatrix::consistent;
  methods::fem::FemRules rules;
  rules.step = window;
  rules.alpha = scene.alpha;
  rules.tolerance = 1e-12;
  return std::make_unique<methods::fem::FemStepper<D>>(std::make_unique<fem::Body<D>>(std::move(body)), std::move(supports), rules);
}

template <int D>
TwoSides<D>::TwoSides(const CouplingScene& scene, Real window)
    : width_(D == 2 ? scene.rules.width : 1),
      fem_(make_fem<D>(scene, window)),
      balls_(make_balls(scene, window / static_cast<Real>(scene.steps))),
      bodies_(std::make_unique<methods::hybrid::SphereSide>(*balls_, 0)) {
  const auto& mesh = fem_->body().mesh();
  continuum_ =
      std::make_unique<methods::hybrid::ContinuumSide<D>>(*fem_, geometry::linear_surface(mesh, *mesh.find_group("top")), scene.rules);
}

template <int D>
void TwoSides<D>::start() {
  fem_->start();
  methods::hybrid::DirectChannel channel(*bodies_);
  continuum_->start(channel.open(continuum_->shape()));
}

template <int D>
void TwoSides<D>::advance(int windows) {
  methods::hybrid::DirectChannel channel(*bodies_);
  for (int window = 0; window < windows; ++window) continuum_->advance(channel);
}

template <int D>
void TwoSides<D>::columns(Archive& archive) {
  archive.folder("fem", [&] { fem_->columns(archive); });
  archive.folder("continuum", [&] { continuum_->columns(archive); });
  archive.folder("bodies", [&] { bodies_->columns(archive); });
  archive.folder("balls", [&] { balls_->columns(archive); });
}

template <int D>
void TwoSides<D>::resume(MemoryArchive& archive) {
  archive.folder("fem", [&] { fem_->columns(archive); });
  archive.folder("continuum", [&] { continuum_->columns(archive); });
  bodies_->attach(continuum_->shape());
  archive.folder("bodies", [&] { bodies_->columns(archive); });
  archive.folder("balls", [&] { balls_->columns(archive); });
}

template <int D>
Vector3 TwoSides<D>::momentum() const {
  const auto momenta = fem::product(fem_->body().mass(), fem_->state().velocity);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < momenta.size(); ++i) sum[static_cast<int>(i % D)] += width_ * momenta[i];
  return sum;
}

template std::unique_ptr<methods::fem::FemStepper<2>> make_fem<2>(const CouplingScene&, Real);
template std::unique_ptr<methods::fem::FemStepper<3>> make_fem<3>(const CouplingScene&, Real);
template class TwoSides<2>;
template class TwoSides<3>;

}  // namespace sazare::test
