#pragma once

/// What the two sides tell each other, as messages of files and back.

#include "sazare/coupling/message.hpp"
#include "sazare/coupling/window_messages.hpp"

namespace sazare::coupling {

Message to_message(const SurfaceShape& shape);
Message to_message(const SurfaceMotion& motion, const SurfaceShape& shape);
Message to_message(const SurfaceForce& force, const SurfaceShape& shape);

/// These throw UserError where a message is of another kind, or its tables do not fit the surface.
SurfaceShape to_shape(Message message);
SurfaceMotion to_motion(Message message, const SurfaceShape& shape);
SurfaceForce to_force(Message message, const SurfaceShape& shape);

/// Throws UserError when the shape is none: no nodes, faces of nodes that are not there or of no size, a window without length.
void check_shape(const SurfaceShape& shape);

/// Throws UserError with the first difference of two shapes that should be the same; `expected` names the side that knows it.
void check_same(const SurfaceShape& expected, const SurfaceShape& got, const std::string& where);

}  // namespace sazare::coupling
