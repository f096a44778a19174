#pragma once

/// The two ends of a channel whose messages are files, see FileExchange: each end in a program of its own.

#include "sazare/coupling/channel.hpp"
#include "sazare/coupling/file_exchange.hpp"

namespace sazare::coupling {

class FileContinuumChannel final : public ContinuumChannel {
public:
  explicit FileContinuumChannel(ExchangeOptions options) : exchange_(std::move(options)) {}

  SurfaceForce open(const SurfaceShape& shape) override;
  /// Instead of `open` when the run is resumed. Throws UserError as well when the shape is not that of the run.
  void reopen(const SurfaceShape& shape);
  SurfaceForce exchange(const SurfaceMotion& motion) override;
  void close() override;

  FileExchange& files() { return exchange_; }
  const FileExchange& files() const { return exchange_; }

private:
  SurfaceForce receive(std::int64_t window, std::int32_t pass);

  FileExchange exchange_;
  SurfaceShape shape_;
  std::int64_t window_ = 0;  ///< the next one
};

class FileBodyChannel final : public BodyChannel {
public:
  explicit FileBodyChannel(ExchangeOptions options) : exchange_(std::move(options)) {}

  /// Waits for the shape, also that of a run that is resumed.
  SurfaceShape open() override;
  std::optional<SurfaceMotion> receive() override;
  void answer(const SurfaceForce& force) override;

  FileExchange& files() { return exchange_; }
  const FileExchange& files() const { return exchange_; }

private:
  FileExchange exchange_;
  SurfaceShape shape_;
};

}  // namespace sazare::coupling
