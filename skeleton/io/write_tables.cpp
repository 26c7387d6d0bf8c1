// CSV: tables of branches, of sections across them and of junctions.
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include "base/decimal.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "skeleton/io/skeleton_formats.hpp"

namespace curveskel {
namespace {

/// A comma and the number, or nothing where there is none.
template <typename Number>
void append_field(std::string& text, Number number, bool is_there = true) {
  text += ',';
  if constexpr (std::is_floating_point_v<Number>) is_there = is_there && !std::isnan(number);
  if (is_there) append_decimal(text, number);
}

/// The same of a life or merge: "inf" where it is for ever.
void append_life(std::string& text, double life, bool is_there) {
  append_field(text, life < lives_for_ever ? life : std::numeric_limits<double>::infinity(),
               is_there);
}

/// A comma and the numbers with spaces between.
template <typename Number>
void append_list(std::string& text, const std::vector<Number>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    text += k == 0 ? ',' : ' ';
    append_decimal(text, numbers[k]);
  }
}

void append_measures(std::string& text, const BranchMeasures& measures) {
  text += ',';
  text += name_of(branch_kinds, measures.kind);
  append_field(text, measures.chord);
  append_field(text, measures.tortuosity);
  append_field(text, measures.least_radius);
  append_field(text, measures.largest_radius);
  append_field(text, measures.curvature);
  append_field(text, measures.torsion);
  append_field(text, measures.parent_angle);
  append_field(text, measures.centrifugal_order);
  append_field(text, measures.strahler_order, measures.strahler_order > 0);
}

void require_parts_of(const std::vector<Branch>& all, const BranchTerritories& parts) {
  const std::size_t found = parts.areas.size();
  if (found == all.size() && parts.volumes.size() == found) return;
  throw Error(Fault::input, "format_skeleton: found territories with areas of " +
                                std::to_string(found) + " branches and volumes of " +
                                std::to_string(parts.volumes.size()) +
                                ", needed those of the skeleton's " + std::to_string(all.size()));
}

}  // namespace

std::string csv_from(const CurveSkeleton& skeleton, const SkeletonContext& context) {
  std::string text =
      "branch,start,end,start_x,start_y,start_z,end_x,end_y,end_z,nodes,length,mean_radius,life,"
      "parent,merge,kind,chord,tortuosity,radius_min,radius_max,curvature,torsion,parent_angle,"
      "centrifugal_order,strahler_order,area,volume,component\n";
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  const std::vector<BranchMeasures> measures = branch_measures(skeleton, context.root);
  const std::vector<int> components = component_of_node(skeleton);
  const std::vector<Branch> all = branches(skeleton);
  const BranchTerritories* parts = context.territories;
  if (parts != nullptr) require_parts_of(all, *parts);
  std::size_t id = 0;
  for (const Branch& branch : all) {
    const BranchLevel& level = levels[id];
    const int start = branch.nodes.front();
    const int end = branch.nodes.back();
    append_decimal(text, id);
    append_field(text, start);
    append_field(text, end);
    text += ',';
    append_decimals(text, skeleton.nodes.row(start), ',');
    text += ',';
    append_decimals(text, skeleton.nodes.row(end), ',');
    append_field(text, branch.nodes.size());
    append_field(text, measures[id].length);
    append_field(text, measures[id].mean_radius);
    append_life(text, level.life, has_lives(skeleton));
    append_field(text, level.parent, level.parent >= 0);
    append_life(text, level.merge, level.merge >= 0);
    append_measures(text, measures[id]);
    append_field(text, parts == nullptr ? 0 : parts->areas[id], parts != nullptr);
    append_field(text, parts == nullptr ? 0 : parts->volumes[id], parts != nullptr);
    append_field(text, components[idx(start)]);
    text += '\n';
    ++id;
  }
  return text;
}

std::string format_profiles(const std::vector<BranchSection>& sections) {
  std::string text =
      "branch,s,x,y,z,tangent_x,tangent_y,tangent_z,inscribed_radius,area,perimeter,"
      "equivalent_diameter,ellipticity,near_junction\n";
  for (const BranchSection& section : sections) {
    append_decimal(text, section.branch);
    append_field(text, section.s);
    text += ',';
    append_decimals(text, section.position.transpose(), ',');
    text += ',';
    append_decimals(text, section.tangent.transpose(), ',');
    append_field(text, section.inscribed_radius);
    append_field(text, section.area);
    append_field(text, section.perimeter);
    append_field(text, section.equivalent_diameter);
    append_field(text, section.ellipticity);
    text += section.near_junction ? ",1\n" : ",0\n";
  }
  return text;
}

std::string format_junctions(const CurveSkeleton& skeleton) {
  require_sound(skeleton, "format_junctions");
  std::string text = "node,x,y,z,degree,branches,angles,planarity\n";
  for (const JunctionMeasures& junction : junction_measures(skeleton)) {
    append_decimal(text, junction.node);
    text += ',';
    append_decimals(text, skeleton.nodes.row(junction.node), ',');
    append_field(text, junction.branches.size());
    append_list(text, junction.branches);
    append_list(text, junction.angles);
    append_field(text, junction.planarity);
    text += '\n';
  }
  return text;
}

}  // namespace curveskel
