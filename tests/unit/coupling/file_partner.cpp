// One side of a coupled run for with_python.py: file_partner SIDE FOLDER WINDOWS [RUN NEXT]. The continuum moves by a share of
// the forces that it gets, the bodies answer with a share of what they are told; both print what they got, in bits.

#include <fmt/format.h>

#include <bit>
#include <cstdlib>

#include "sazare/coupling/file_channel.hpp"

namespace {

using namespace sazare;
using namespace sazare::coupling;

void print(std::int64_t window, const std::vector<Real>& values) {
  fmt::print("{}", window);
  for (const Real value : values) fmt::print(" {:016x}", std::bit_cast<std::uint64_t>(value));
  fmt::print("\n");
  std::fflush(stdout);
}

std::vector<Real> scaled(const std::vector<Real>& values, Real by) {
  std::vector<Real> result = values;
  for (Real& value : result) value *= by;
  return result;
}

void lead(ExchangeOptions options, std::int64_t windows) {
  FileContinuumChannel channel(std::move(options));
  const SurfaceShape shape{2, 0.5, 1e-3, {0, 0, 1, 0, 1, 1}, {0, 1, 1, 2}};
  SurfaceForce force = channel.open(shape);
  std::vector<Real> place(6, 0.1);
  for (std::int64_t window = 0; window < windows; ++window) {
    for (std::size_t i = 0; i < place.size(); ++i) place[i] += 0.3 * force.mean[i] + 0.7 * force.last[i];
    force = channel.exchange({window, 0, static_cast<Real>(window + 1) * shape.window, place, scaled(place, 1.0 / 3)});
    print(window, force.mean);
  }
  channel.close();
}

void follow(ExchangeOptions options) {
  FileBodyChannel channel(std::move(options));
  const SurfaceShape shape = channel.open();
  if (channel.files().next() == 0) channel.answer({-1, 0, 0, scaled(shape.nodes, 0.7), scaled(shape.nodes, 0.9)});
  while (const std::optional<SurfaceMotion> motion = channel.receive()) {
    print(motion->window, motion->displacement);
    channel.answer(
        {motion->window, motion->pass, motion->time, scaled(motion->displacement, -0.7), scaled(motion->velocity, 1.1)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::string side = argv[1];
  ExchangeOptions options{argv[2], side == "bodies" ? Side::bodies : Side::continuum, {}, true, 20, nullptr};
  if (argc == 6) options.mark = {argv[4], std::atoll(argv[5])};
  try {
    if (side == "bodies")
      follow(std::move(options));
    else
      lead(std::move(options), std::atoll(argv[3]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 4;
  }
  return 0;
}
