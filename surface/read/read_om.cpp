// OpenMesh's OM format. OpenMesh's reader takes a file's counts, sizes and property types on trust,
// so the file is first gone through chunk by chunk, and only positions and topology are handed on,
// once they are known to be there in full.
#include <OpenMesh/Core/IO/OMFormat.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OMReader.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <cstring>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "surface/mesh/silence_openmesh.hpp"
#include "surface/read/formats.hpp"

namespace curveskel {
namespace {

namespace om = OpenMesh::IO::OMFormat;

constexpr std::size_t header_bytes = 16;
const om::uint8 newest_version = om::mk_version(2, 2);
const om::uint8 first_version_of_half_edges = om::mk_version(2, 0);

[[noreturn]] void fail_as_broken(const FileBytes& file, const std::string& found,
                                 const std::string& needed) {
  file.fail(found, needed, "the file is truncated or broken: fetch or export it again");
}

struct OmChunk {
  om::Chunk::Header header;
  std::size_t begin;  // of its header in the file
  std::size_t data;   // begin of its data
  std::size_t end;
};

/// Goes from chunk to chunk without reading what is in them.
class OmChunks {
 public:
  explicit OmChunks(const FileBytes& file) : file_(file) {
    if (file.content.size() < header_bytes) {
      fail_as_broken(file, std::to_string(file.content.size()) + " bytes",
                     "the 16 bytes of a header");
    }
    kind_ = file.content[2];
    version_ = static_cast<om::uint8>(file.content[3]);
    vertices_ = value<std::uint32_t>(4);
    faces_ = value<std::uint32_t>(8);
    edges_ = value<std::uint32_t>(12);
    if (version_ > newest_version) {
      file.fail("OM of version " + om::as_string(version_),
                "at most version " + om::as_string(newest_version),
                "write it again with OpenMesh 9 or older");
    }
    const auto most = static_cast<std::size_t>(most_vertices);
    if (vertices_ > most || faces_ > most || 2 * edges_ > most) {
      file.fail(std::to_string(vertices_) + " vertices, " + std::to_string(faces_) + " faces and " +
                    std::to_string(edges_) + " edges announced",
                "at most " + std::to_string(most) + " of each, half as many edges",
                "split or decimate the surface first");
    }
  }

  [[nodiscard]] std::optional<OmChunk> next() {
    if (ended_ || place_ == file_.content.size()) return std::nullopt;
    OmChunk chunk{};
    chunk.begin = place_;
    chunk.header << value<om::uint16>(advance(sizeof(om::uint16)));
    ended_ = chunk.header.entity_ == om::Chunk::Entity_Sentinel;
    if (ended_) return std::nullopt;
    if (chunk.header.name_ != 0) skip_name();
    chunk.data = place_;
    skip_data(chunk.header);
    chunk.end = place_;
    return chunk;
  }

  [[nodiscard]] std::size_t vertices() const { return vertices_; }
  [[nodiscard]] std::size_t faces() const { return faces_; }
  [[nodiscard]] std::size_t edges() const { return edges_; }
  [[nodiscard]] bool has_half_edges() const { return version_ >= first_version_of_half_edges; }

 private:
  template <typename Value>
  [[nodiscard]] Value value(std::size_t place) const {
    Value result{};
    std::memcpy(&result, file_.content.data() + place, sizeof result);
    return result;
  }

  /// Returns where the bytes begin that it passes over.
  std::size_t advance(std::size_t bytes) {
    if (bytes > file_.content.size() - place_) {
      fail_as_broken(file_,
                     "a chunk of " + std::to_string(bytes) + " bytes " +
                         std::to_string(file_.content.size() - place_) + " bytes before the end",
                     "chunks that fit into the file");
    }
    return std::exchange(place_, place_ + bytes);
  }

  void skip_name() { advance(value<std::uint8_t>(advance(1))); }

  void skip_data(const om::Chunk::Header& chunk) {
    if (chunk.type_ == om::Chunk::Type_Custom) {
      if (version_ > om::mk_version(2, 1)) skip_name();  // of the values' type
      advance(value<std::uint32_t>(advance(sizeof(std::uint32_t))));
    } else if (chunk.type_ == om::Chunk::Type_Topology) {
      skip_topology(chunk);
    } else if (chunk.type_ == om::Chunk::Type_Status) {
      advance(sizeof(std::uint32_t) * count_of(chunk));
    } else {
      const std::size_t scalar = (chunk.float_ != 0 ? 4U : 1U) << chunk.bits_;
      advance((chunk.dim_ + 1) * scalar * count_of(chunk));
    }
  }

  void skip_topology(const om::Chunk::Header& chunk) {
    if (chunk.bits_ > om::Chunk::Integer_32) {
      fail_as_broken(file_, "topology in numbers of 64 bits", "at most 32 bits");
    }
    const std::size_t index_bytes = std::size_t{1} << chunk.bits_;
    if (chunk.entity_ == om::Chunk::Entity_Halfedge) {
      advance(3 * index_bytes * count_of(chunk));  // the next one, the vertex and the face of each
    } else if (chunk.entity_ != om::Chunk::Entity_Face || has_half_edges()) {
      advance(index_bytes * count_of(chunk));
    } else if (kind_ != 'P') {
      advance((kind_ == 'Q' ? 4 : 3) * index_bytes * faces_);
    } else {
      for (std::size_t f = 0; f < faces_; ++f) {
        advance(index_bytes * value<std::uint16_t>(advance(sizeof(std::uint16_t))));
      }
    }
  }

  [[nodiscard]] std::size_t count_of(const om::Chunk::Header& chunk) const {
    switch (chunk.entity_) {
      case om::Chunk::Entity_Vertex:
        return vertices_;
      case om::Chunk::Entity_Face:
        return faces_;
      case om::Chunk::Entity_Edge:
        return edges_;
      case om::Chunk::Entity_Halfedge:
        return 2 * edges_;
      case om::Chunk::Entity_Mesh:
        return 1;
      default:
        break;
    }
    fail_as_broken(file_, "a chunk of entity " + std::to_string(chunk.entity_),
                   "one of a vertex, face, edge, half-edge or mesh");
  }

  const FileBytes& file_;
  std::size_t place_ = header_bytes;
  char kind_ = 'T';
  om::uint8 version_ = 0;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::size_t edges_ = 0;
  bool ended_ = false;
};

/// The header and the chunks that hold positions and topology, each once.
std::string geometry_of(const FileBytes& file, OmChunks& chunks) {
  using Chunk = om::Chunk;
  std::string geometry = file.content.substr(0, header_bytes);
  bool has_positions = false;
  bool has_faces = false;
  bool has_half_edges = false;
  while (const auto chunk = chunks.next()) {
    const Chunk::Header& header = chunk->header;
    const bool is_position =
        header.entity_ == Chunk::Entity_Vertex && header.type_ == Chunk::Type_Pos;
    const bool is_topology = header.type_ == Chunk::Type_Topology;
    bool* seen = nullptr;
    if (is_position) seen = &has_positions;
    if (is_topology && header.entity_ == Chunk::Entity_Face) seen = &has_faces;
    if (is_topology && header.entity_ == Chunk::Entity_Halfedge) seen = &has_half_edges;
    if (seen == nullptr) continue;
    const bool is_point =
        header.dim_ == Chunk::Dim_3D && header.float_ != 0 && header.bits_ <= Chunk::Float_64;
    if (header.name_ != 0 || std::exchange(*seen, true) || (is_position && !is_point)) {
      fail_as_broken(file, "positions or topology twice, named or of an unknown type",
                     "one chunk of positions with three single or double coordinates each, and one "
                     "of the topology of each entity");
    }
    geometry.append(file.content, chunk->begin, chunk->end - chunk->begin);
  }
  const bool has_all = (has_positions || chunks.vertices() == 0) &&
                       (has_faces || chunks.faces() == 0) &&
                       (has_half_edges || chunks.faces() == 0 || !chunks.has_half_edges());
  if (!has_all) {
    fail_as_broken(file, "no chunk of positions or of topology", "both");
  }
  return geometry;
}

/// Takes positions and topology from OpenMesh's reader as they come, and nothing else. The corners
/// of files older than half-edges come face by face.
class OmImporter final : public OpenMesh::IO::BaseImporter {
 public:
  using Vertex = OpenMesh::VertexHandle;
  using HalfEdge = OpenMesh::HalfedgeHandle;
  using Edge = OpenMesh::EdgeHandle;
  using Face = OpenMesh::FaceHandle;
  using Status = OpenMesh::Attributes::StatusInfo;

  std::vector<double> coordinates;
  std::vector<std::int32_t> corners;
  std::vector<std::int64_t> offsets{0};
  std::vector<int> target;      ///< per half-edge, the vertex that it leads to
  std::vector<int> next;        ///< per half-edge
  std::vector<int> first_edge;  ///< per face, a half-edge

  Vertex add_vertex(const OpenMesh::Vec3f& p) override { return add_vertex(OpenMesh::Vec3d(p)); }
  Vertex add_vertex(const OpenMesh::Vec3d& p) override {
    coordinates.insert(coordinates.end(), {p[0], p[1], p[2]});
    return Vertex(static_cast<int>(coordinates.size() / 3) - 1);
  }
  Vertex add_vertex() override { return add_vertex(OpenMesh::Vec3d(0, 0, 0)); }
  HalfEdge add_edge(Vertex from, Vertex to) override {
    target.insert(target.end(), {to.idx(), from.idx()});
    next.insert(next.end(), {-1, -1});
    return HalfEdge(static_cast<int>(target.size()) - 2);
  }
  Face add_face(const VHandles& vertices) override {
    for (const Vertex vertex : vertices) corners.push_back(vertex.idx());
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
    return Face(static_cast<int>(offsets.size()) - 2);
  }
  Face add_face(HalfEdge half_edge) override {
    first_edge.push_back(half_edge.idx());
    return Face(static_cast<int>(first_edge.size()) - 1);
  }
  void set_next(HalfEdge half_edge, HalfEdge following) override {
    next[idx(half_edge.idx())] = following.idx();
  }
  OpenMesh::BaseKernel* kernel() override { return &kernel_; }
  [[nodiscard]] std::size_t n_vertices() const override { return coordinates.size() / 3; }
  [[nodiscard]] std::size_t n_faces() const override {
    return offsets.size() - 1 + first_edge.size();
  }
  [[nodiscard]] std::size_t n_edges() const override { return target.size() / 2; }

  void set_point(Vertex /*v*/, const OpenMesh::Vec3f& /*p*/) override {}
  void set_halfedge(Vertex /*v*/, HalfEdge /*h*/) override {}
  void set_face(HalfEdge /*h*/, Face /*f*/) override {}
  void set_normal(Vertex /*v*/, const OpenMesh::Vec3f& /*n*/) override {}
  void set_normal(Vertex /*v*/, const OpenMesh::Vec3d& /*n*/) override {}
  void set_normal(Face /*f*/, const OpenMesh::Vec3f& /*n*/) override {}
  void set_normal(Face /*f*/, const OpenMesh::Vec3d& /*n*/) override {}
  void set_color(Vertex /*v*/, const OpenMesh::Vec3uc& /*c*/) override {}
  void set_color(Vertex /*v*/, const OpenMesh::Vec4uc& /*c*/) override {}
  void set_color(Vertex /*v*/, const OpenMesh::Vec3f& /*c*/) override {}
  void set_color(Vertex /*v*/, const OpenMesh::Vec4f& /*c*/) override {}
  void set_color(Edge /*e*/, const OpenMesh::Vec3uc& /*c*/) override {}
  void set_color(Edge /*e*/, const OpenMesh::Vec4uc& /*c*/) override {}
  void set_color(Edge /*e*/, const OpenMesh::Vec3f& /*c*/) override {}
  void set_color(Edge /*e*/, const OpenMesh::Vec4f& /*c*/) override {}
  void set_color(Face /*f*/, const OpenMesh::Vec3uc& /*c*/) override {}
  void set_color(Face /*f*/, const OpenMesh::Vec4uc& /*c*/) override {}
  void set_color(Face /*f*/, const OpenMesh::Vec3f& /*c*/) override {}
  void set_color(Face /*f*/, const OpenMesh::Vec4f& /*c*/) override {}
  void set_status(Vertex /*v*/, const Status& /*s*/) override {}
  void set_status(HalfEdge /*h*/, const Status& /*s*/) override {}
  void set_status(Edge /*e*/, const Status& /*s*/) override {}
  void set_status(Face /*f*/, const Status& /*s*/) override {}
  void set_texcoord(Vertex /*v*/, const OpenMesh::Vec2f& /*t*/) override {}
  void set_texcoord(Vertex /*v*/, const OpenMesh::Vec3f& /*t*/) override {}
  void set_texcoord(HalfEdge /*h*/, const OpenMesh::Vec2f& /*t*/) override {}
  void set_texcoord(HalfEdge /*h*/, const OpenMesh::Vec3f& /*t*/) override {}
  void add_face_texcoords(Face /*f*/, Vertex /*v*/,
                          const std::vector<OpenMesh::Vec2f>& /*t*/) override {}
  void add_face_texcoords(Face /*f*/, Vertex /*v*/,
                          const std::vector<OpenMesh::Vec3f>& /*t*/) override {}
  void set_face_texindex(Face /*f*/, int /*texture*/) override {}
  void request_face_texcoords2D() override {}
  void add_texture_information(int /*texture*/, std::string /*name*/) override {}

 private:
  OpenMesh::BaseKernel kernel_;  // OpenMesh's reader wants one; no property is ever put into it
};

/// The vertices round each face, found from half-edge to half-edge.
void follow_half_edges(const FileBytes& file, OmImporter& read) {
  std::vector<bool> passed(read.next.size(), false);
  const auto is_open = [&](int h) {
    return h >= 0 && h < static_cast<int>(passed.size()) && !passed[idx(h)];
  };
  for (std::size_t f = 0; f < read.first_edge.size(); ++f) {
    const int first = read.first_edge[f];
    int h = first;
    do {
      if (!is_open(h)) {
        fail_as_broken(file,
                       "half-edge " + std::to_string(h) + " on the way round face " +
                           std::to_string(f) + " (both counted from 0)",
                       "a half-edge of that face alone");
      }
      passed[idx(h)] = true;
      read.corners.push_back(read.target[idx(h)]);
      h = read.next[idx(h)];
    } while (h != first);
    read.offsets.push_back(static_cast<std::int64_t>(read.corners.size()));
  }
}

void require_sound(const FileBytes& file, const OmImporter& read) {
  const auto vertices = static_cast<std::int32_t>(read.n_vertices());
  for (const std::int32_t corner : read.corners) {
    if (corner >= 0 && corner < vertices) continue;
    file.fail("vertex index " + std::to_string(corner),
              "indices from 0 to " + std::to_string(vertices - 1), "export the file again");
  }
}

}  // namespace

PolygonSoup read_om(const FileBytes& file, const Monitor& monitor) {
  OmChunks chunks(file);
  std::istringstream geometry(geometry_of(file, chunks));
  monitor.report("read", 0.3);
  OmImporter read;
  {
    static std::mutex one_at_a_time;  // OpenMesh's reader keeps its state in a singleton
    const std::lock_guard guard(one_at_a_time);
    silence_openmesh();
    OpenMesh::IO::Options options;
    if (!OpenMesh::IO::OMReader().read(geometry, read, options) ||
        read.n_vertices() != chunks.vertices() || read.n_faces() != chunks.faces()) {
      fail_as_broken(file, "what OpenMesh cannot read", "an OM file");
    }
  }
  monitor.report("read", 0.8);
  follow_half_edges(file, read);
  require_sound(file, read);
  PolygonSoup soup;
  soup.format = SurfaceFormat::om;
  soup.positions = positions_from(read.coordinates);
  soup.corners = std::move(read.corners);
  soup.offsets = std::move(read.offsets);
  return soup;
}

bool looks_like_om(const FileBytes& file) {
  const std::string_view content = file.content;
  return content.size() >= header_bytes && content.starts_with("OM") &&
         std::string_view("TQP").find(content[2]) != std::string_view::npos;
}

}  // namespace curveskel
