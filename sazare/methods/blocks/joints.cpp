#include "sazare/methods/blocks/joints.hpp"

#include "sazare/methods/blocks/joint_loops.hpp"

namespace sazare::methods::blocks {

template class JointsOf<laws::JointLaws>;

}  // namespace sazare::methods::blocks
