#include "viewer/software/panel_changes.hpp"

#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <limits>

namespace curveskel::viewer {
namespace {

struct PanelBox {
  float left = std::numeric_limits<float>::max();
  float top = std::numeric_limits<float>::max();
  float right = std::numeric_limits<float>::lowest();
  float bottom = std::numeric_limits<float>::lowest();

  void add(const ImVec2& at) {
    left = std::min(left, at.x);
    top = std::min(top, at.y);
    right = std::max(right, at.x);
    bottom = std::max(bottom, at.y);
  }
  [[nodiscard]] bool empty() const { return !(left <= right && top <= bottom); }
  [[nodiscard]] Area area() const { return whole_pixels({left, top, right - left, bottom - top}); }
};

bool same_vertex(const ImDrawVert& a, const ImDrawVert& b) {
  return a.pos.x == b.pos.x && a.pos.y == b.pos.y && a.uv.x == b.uv.x && a.uv.y == b.uv.y &&
         a.col == b.col;
}

}  // namespace

PanelChanges::Kept PanelChanges::copy_of(const ImDrawList& list) {
  return {{list.VtxBuffer.begin(), list.VtxBuffer.end()},
          {list.IdxBuffer.begin(), list.IdxBuffer.end()},
          {list.CmdBuffer.begin(), list.CmdBuffer.end()}};
}

bool PanelChanges::same_commands(const Kept& one, const Kept& other) {
  return std::equal(one.commands.begin(), one.commands.end(), other.commands.begin(),
                    other.commands.end(), [](const ImDrawCmd& a, const ImDrawCmd& b) {
                      return a.ClipRect.x == b.ClipRect.x && a.ClipRect.y == b.ClipRect.y &&
                             a.ClipRect.z == b.ClipRect.z && a.ClipRect.w == b.ClipRect.w &&
                             a.TextureId == b.TextureId;
                    });
}

/// The triangles of which a corner is new or gone. Where the clipping has changed, all.
void PanelChanges::add_changes(const Kept& before, const Kept& now, std::vector<Area>& areas) {
  const auto& a = before.vertices;
  const auto& b = now.vertices;
  const std::size_t shorter = std::min(a.size(), b.size());
  std::size_t first = 0;  // those before it are the same
  while (first < shorter && same_vertex(a[first], b[first])) ++first;
  std::size_t after = 0;  // as many at the end are
  while (after < shorter - first && same_vertex(a[a.size() - 1 - after], b[b.size() - 1 - after])) {
    ++after;
  }
  const bool same_count = a.size() == b.size();
  if (!same_commands(before, now) || (same_count && before.indices != now.indices)) {
    first = after = 0;
  } else if (same_count && first == a.size()) {
    return;
  }
  PanelBox box;
  for (const Kept* const list : {&before, &now}) {
    const std::size_t last = list->vertices.size() - after;
    for (const ImDrawCmd& command : list->commands) {
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        const auto corner = [&](unsigned k) {
          return command.VtxOffset + list->indices[command.IdxOffset + i + k];
        };
        const auto changed = [&](std::size_t vertex) { return vertex >= first && vertex < last; };
        if (!changed(corner(0)) && !changed(corner(1)) && !changed(corner(2))) continue;
        for (unsigned k = 0; k < 3; ++k) box.add(list->vertices[corner(k)].pos);
      }
    }
  }
  if (!box.empty()) areas.push_back(box.area());
}

std::vector<Area> PanelChanges::since_last(const ImDrawData& data) {
  std::vector<Kept> now;
  now.reserve(static_cast<std::size_t>(data.CmdListsCount));
  for (int i = 0; i < data.CmdListsCount; ++i) now.push_back(copy_of(*data.CmdLists[i]));
  std::vector<Area> areas;
  if (now.size() != kept_.size()) {
    areas.push_back({data.DisplayPos.x, data.DisplayPos.y, data.DisplaySize.x, data.DisplaySize.y});
  } else {
    for (std::size_t i = 0; i < now.size(); ++i) add_changes(kept_[i], now[i], areas);
  }
  kept_ = std::move(now);
  return areas;
}

void draw_within(ImDrawData& data, const Area& area) {
  std::vector<ImVec4> clips;
  const auto for_commands = [&](const auto& change) {
    for (int i = 0; i < data.CmdListsCount; ++i) {
      for (ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) change(command.ClipRect);
    }
  };
  // A command whose clipping is empty is passed over.
  for_commands([&](ImVec4& clip) {
    clips.push_back(clip);
    clip = {std::max(clip.x, area.x), std::max(clip.y, area.y),
            std::min(clip.z, area.x + area.width), std::min(clip.w, area.y + area.height)};
  });
  ImGui_ImplOpenGL3_RenderDrawData(&data);
  std::size_t next = 0;
  for_commands([&](ImVec4& clip) { clip = clips[next++]; });
}

}  // namespace curveskel::viewer
