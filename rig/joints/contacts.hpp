// The places where components touch.
#pragma once

#include <stop_token>
#include <vector>

#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

/// Of each two components whose surfaces come nearer than the thicker one is thick (the radius of
/// its largest ball), by patches of both. Counted is the part of the smaller surface that is
/// inside the other one or faces it from no farther than their gap and half of the thinner one's
/// thickness: its section is the sum of its area as vectors, so that of a limb that ends inside
/// another it is the limb's, however deep it goes, and of a rivet inside it is nothing. None where
/// node_of_vertex is empty. About a million nearest points at most, whatever the components. Throws
/// Cancelled on a stop.
[[nodiscard]] std::vector<Contact> contacts_of(const Surface& surface,
                                               const CurveSkeleton& skeleton,
                                               const std::stop_token& stop = {});

/// A component that is no longer along its curve than across has no axis of its own, as a cube: a
/// chain of it turns about its middle, to lead on from the contact by which the component hangs,
/// or from one to the other where there are two. Its vertices go to the nearest of its nodes.
/// Precondition: the skeleton has its contacts.
void turn_to_contacts(CurveSkeleton& skeleton, const Surface& surface);

}  // namespace curveskel
