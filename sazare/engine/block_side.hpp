#pragma once

/// Blocks on the bodies' side of a coupling. A window is a whole number of base steps.

#include <optional>

#include "sazare/core/memory_archive.hpp"
#include "sazare/engine/body_side.hpp"
#include "sazare/engine/simulation.hpp"
#include "sazare/engine/slab_surface.hpp"
#include "sazare/methods/blocks/surface_contacts.hpp"

namespace sazare::engine {

class BlockSide final : public BodySide {
public:
  /// `contacts` are a term of the simulation; both must outlive the side. `can_return`: to a window's beginning, for which the
  /// blocks are copied.
  BlockSide(Simulation<3>& simulation, methods::blocks::SurfaceContacts& contacts, bool can_return = true)
      : simulation_(&simulation), contacts_(&contacts), can_return_(can_return) {}

  void attach(const coupling::SurfaceShape& shape) override;
  coupling::SurfaceForce start() override;
  coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) override;
  void take_back() override;
  std::int64_t windows() const override { return course_.windows(); }
  std::int64_t steps_per_window() const override { return course_.steps(); }
  void columns(Archive& archive) override { course_.columns(archive); }

private:
  void go_back();

  Simulation<3>* simulation_;
  methods::blocks::SurfaceContacts* contacts_;
  bool can_return_;
  WindowCourse course_;
  SlabSurface surface_;
  std::optional<MemoryArchive> saved_;  ///< the blocks at the last window's beginning
};

}  // namespace sazare::engine
