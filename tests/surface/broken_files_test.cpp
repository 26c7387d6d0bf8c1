// Broken files are refused when they are read, by the file's name and the place in it.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/own_folder.hpp"
#include "tests/surface/encodings.hpp"
#include "tests/surface/reading.hpp"
#include "tests/surface/zip_encodings.hpp"

namespace curveskel::broken_files_laws {
namespace {

struct Broken {
  std::string name;
  std::string file;
  std::string bytes;
  std::vector<std::string> said;  ///< parts of the message

  friend void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }
};

std::string gltf_uri() {
  return R"("uri": "data:application/octet-stream;base64,)" +
         encodings::base64(encodings::gltf_buffer()) + R"(", )";
}

std::string ply_header(const std::string& vertices, const std::string& faces,
                       const std::string& encoding = "ascii") {
  return "ply\nformat " + encoding + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// A Points array, packed: the numbers of its header, and no data to speak of.
std::string vtp_that_announces(const std::string& piece, const std::string& type,
                               const std::vector<std::uint32_t>& header) {
  std::string bytes;
  for (const std::uint32_t number : header) encodings::append(bytes, number);
  return "<VTKFile type=\"PolyData\" compressor=\"vtkZLibDataCompressor\"><PolyData>\n"
         "<" +
         piece + "><Points><DataArray Name=\"Points\" type=\"" + type + "\" format=\"binary\">" +
         encodings::base64(bytes) + encodings::base64(std::string(300, 'x')) +
         "</DataArray></Points></Piece></PolyData></VTKFile>";
}

std::vector<Broken> broken_files() {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"empty", "a.obj", "", {"0 bytes"}},
      {"obj_index_zero",
       "a.obj",
       three + "f 0 1 2\n",
       {"line 4", "\"0\"", "counts vertices from 1"}},
      {"obj_index_too_large",
       "a.obj",
       three + "f 1 2 3\nf 1 2 4\n",
       {"line 5", "vertex 4", "at most 3"}},
      {"obj_index_too_negative", "a.obj", three + "f -1 -2 -4\n", {"line 4", "\"-4\""}},
      {"obj_index_word", "a.obj", three + "f 1 2 x\n", {"line 4", "\"x\"", "a vertex index"}},
      {"obj_index_glued", "a.obj", three + "f 1 2 3x\n", {"line 4", "\"x\"", "a vertex index"}},
      {"obj_two_coordinates",
       "a.obj",
       "v 0 0\nv 1 0 0\n",
       {"line 1", "the end of the line", "z coordinate"}},
      {"obj_decimal_comma", "a.obj", "v 0,5 0 0\n", {"line 1", "\"0,5\"", "x coordinate"}},
      {"obj_nan",
       "a.obj",
       three + "v 0 nan 0\nf 1 2 4\n",
       {"1 of 4 vertices", "vertex 3", "1 of 1 faces"}},
      {"obj_too_large", "a.obj", three + "v 0 1e999 0\nf 1 2 4\n", {"1 of 4 vertices"}},
      {"obj_lines", "a.obj", three + "l 1 2 3\n", {"1 line (", "no faces"}},
      {"obj_free_forms",
       "a.obj",
       three + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 1\nend\n",
       {"free-form surfaces: 1", "export it as a mesh"}},
      {"obj_points", "a.obj", three, {"point cloud", "3 vertices"}},
      {"obj_utf16_odd", "a.obj", encodings::utf16(three, true) + "x", {"an odd number of bytes"}},
      {"off_words",
       "a.off",
       "OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
       {"line 3", "\"zero\"", "z coordinate"}},
      {"off_index",
       "a.off",
       "OFF\n3 1 0\n" + points + "3 0 1 3\n",
       {"line 6", "\"3\"", "from 0 to 2"}},
      {"off_truncated",
       "a.off",
       "OFF\n3 4 0\n" + points + "3 0 1 2\n# one of four\n",
       {"the end of the file after 1", "4 faces"}},
      {"off_counts",
       "a.off",
       "OFF\n2000000000 2000000000 0\n0 0 0\n",
       {"line 2", "2000000000 vertices", "6 bytes"}},
      {"off_corners",
       "a.off",
       "OFF\n3 1 0\n" + points + "999999999 0 1 2\n",
       {"line 6", "\"999999999\"", "number of corners"}},
      {"off_negative_counts", "a.off", "OFF\n-3 1 0\n" + points, {"line 2", "-3 vertices"}},
      {"off_in_four_dimensions", "a.off", "4OFF\n3 1 0\n", {"line 1", "three dimensions"}},
      {"off_in_five_dimensions", "a.off", "nOFF 5\n3 1 0\n", {"line 1", "three dimensions"}},
      {"off_binary_without_counts", "a.off", "OFF BINARY\n", {"0 bytes after byte 11"}},
      {"off_binary_counts",
       "a.off",
       "OFF BINARY\n\x7f\xff\xff\xff\x7f\xff\xff\xff____",
       {"2147483647 vertices", "0 bytes that follow"}},
      {"off_binary_index",
       "a.off",
       encodings::off_binary("OFF", 0).replace(11 + 12 + 96 + 4, 4, std::string(4, '\1')),
       {"vertex 16843009 in face 0", "from 0 to 7"}},
      {"off_binary_corners",
       "a.off",
       encodings::off_binary("OFF", 0).replace(11 + 12 + 96, 4, std::string(4, '\x7f')),
       {"bytes after byte 123"}},
      {"off_binary_coloured_by_openmesh",
       "a.off",
       encodings::off_binary("COFF", 4, false),
       {"OpenMesh"}},
      {"off_of_other_content", "a.off", "hello\n", {"line 1", "\"hello\"", "\"OFF\""}},
      {"off_inf",
       "a.off",
       "OFF\n3 1 0\n0 0 -inf\n1 0 0\n0 1 0\n3 0 1 2\n",
       {"infinity in 1 of 3 vertices"}},
      {"ply_magic", "a.ply", "plx\n", {"line 1", "\"plx\"", "\"ply\""}},
      {"ply_header_ends",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\n",
       {"end_header", "truncated"}},
      {"ply_type",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty flaot x\nend_header\n",
       {"line 4", "\"flaot\"", "a type"}},
      {"ply_format",
       "a.ply",
       "ply\nformat binary 1.0\nend_header\n",
       {"line 2", "\"binary\"", "binary_little_endian"}},
      {"ply_keyword",
       "a.ply",
       "ply\nformat ascii 1.0\nelment vertex 3\nend_header\n",
       {"line 3", "\"elment\""}},
      {"ply_without_z",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 "
       "0\n",
       {"\"z\""}},
      {"ply_counts",
       "a.ply",
       ply_header("4000000000", "1", "binary_little_endian") + points,
       {"4000000000 rows", "\"vertex\""}},
      {"ply_ascii_counts",
       "a.ply",
       ply_header("3", "4000000000") + points,
       {"4000000000 rows", "\"face\""}},
      {"ply_negative_count", "a.ply", ply_header("-1", "1"), {"line 3", "\"-1\""}},
      {"ply_word",
       "a.ply",
       ply_header("3", "1") + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n",
       {"line 11", "\"zero\""}},
      {"ply_index",
       "a.ply",
       ply_header("3", "1") + points + "3 0 1 3\n",
       {"line 13", "vertex index 3", "0 to 2"}},
      {"ply_nan",
       "a.ply",
       ply_header("3", "1") + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
       {"1 of 3 vertices", "vertex 1", "1 of 1 faces"}},
      {"ply_points", "a.ply", ply_header("3", "0") + points, {"point cloud", "3 vertices"}},
      {"stl_truncated",
       "a.stl",
       encodings::stl_binary("x").substr(0, 300),
       {"12 facets", "300 bytes", "684 bytes"}},
      {"stl_short", "a.stl", "nothing", {"7 bytes"}},
      {"stl_text_truncated",
       "a.stl",
       encodings::stl_text().substr(0, encodings::stl_text().find("    endloop")),
       {"the end of the file", "endfacet"}},
      {"stl_without_end",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\n",
       {"endsolid"}},
      {"stl_two_vertices",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 "
       "0\nendloop\nendfacet\nendsolid\n",
       {"line 7", "2 vertices"}},
      {"stl_word",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertx 0 0 0\n",
       {"line 4", "\"vertx\""}},
      {"stl_nan",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 nan 0\nvertex 1 0 0\n"
       "vertex 0 1 0\nendloop\nendfacet\nendsolid\n",
       {"1 of 3 vertices", "1 of 1 faces"}},
      {"stl_vertex_without_facet",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nvertex 0 0 0\nendsolid\n",
       {"line 9", "\"vertex\"", "\"facet\" before"}},
      {"stl_facet_in_facet",
       "a.stl",
       "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendsolid\n",
       {"line 6", "\"endsolid\"", "\"endfacet\" first"}},
      {"glb_truncated", "a.glb", encodings::glb().substr(0, 500), {"chunk", "truncated"}},
      {"glb_short", "a.glb", "glTF", {"glTF"}},
      {"gltf_without_version", "a.gltf", "{}", {"glTF"}},
      {"gltf_no_json", "a.gltf", "{\"asset\": ", {"glTF"}},
      {"gltf_short_buffer",
       "a.gltf",
       encodings::gltf_json(R"("uri": "data:application/octet-stream;base64,AAAA", )"),
       {"glTF"}},
      {"gltf_endless_buffer", "a.gltf", encodings::gltf_json(R"("uri": "/dev/zero", )"), {"glTF"}},
      {"gltf_deep",
       "a.gltf",
       R"({"asset": {"version": "2.0", "extras": )" + std::string(100000, '[') +
           std::string(100000, ']') + "}}",
       {"nested 100002 deep"}},
      {"gltf_points",
       "a.gltf",
       encodings::gltf_json(gltf_uri(), encodings::one_node, R"("mode": 0)"),
       {"a point cloud", "reconstruct a surface"}},
      {"gltf_lines",
       "a.gltf",
       encodings::gltf_json(gltf_uri(), encodings::one_node, R"("mode": 3)"),
       {"a drawing of lines"}},
      {"fbx_sent_as_text",
       "a.fbx",
       "Kaydara FBX Binary     \x1A \xE8 rest",
       {"binary FBX", "fetch the file again, as binary"}},
      {"gltf_nothing", "a.gltf", R"({"asset": {"version": "2.0"}})", {"0 vertices"}},
      {"unknown",
       "a.xyz",
       "hello",
       {"\"hello\"", "obj, off, ply, stl, om, gltf, glb, vtp, vtk, 3mf, dae, fbx"}},
      {"blender_scene", "a.obj", "BLENDER-v304RENDH", {"a Blender scene", "export it as .glb"}},
      {"bvh_motion", "a.bvh", "HIERARCHY\nROOT hips\n{\n", {"a BVH motion"}},
      {"step_file", "a.step", "ISO-10303-21;\nHEADER;\n", {"a STEP file"}},
      {"x3d_scene", "a.x3d", "<?xml version=\"1.0\"?>\n<X3D version=\"3.3\"/>", {"an X3D scene"}},
      {"own_skeleton",
       "a.json",
       "{\n\"format\": \"curveskel skeleton\", \"version\": 1",
       {"a skeleton of curveskel", "give the surface"}},
      {"own_rig",
       "a.json",
       "{\"format\": \"curveskel-rig\", \"version\": 1",
       {"a rig of curveskel", "give the surface"}},
      {"ply_skeleton",
       "a.ply",
       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
       "property float z\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
       "end_header\n0 0 0\n1 0 0\n0 1\n",
       {"a skeleton or a drawing of lines: 1 edge and no faces", "give the surface"}},
      {"vtp_skeleton",
       "a.vtp",
       "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\" NumberOfLines=\"1\">"
       "<Points><DataArray type=\"Float64\" format=\"ascii\">0 0 0 1 0 0</DataArray></Points>"
       "</Piece></PolyData></VTKFile>",
       {"a skeleton or a drawing of lines", "give the surface"}},
      {"swc_skeleton", "a.swc", "1 0 0 0 0 1 -1\n", {"a skeleton file (swc)", "give the surface"}},
      {"one_point", "a.off", "OFF\n1 0 0\n0 0 0\n", {"1 vertex and no faces"}},
      {"usd", "a.usda", "#usda 1.0\n(\n", {"a USD scene", "does not read it"}},
      {"usd_archive",
       "a.usdz",
       encodings::zip({{"rig.usda", "#usda 1.0\n"}}),
       {"a USD scene (USDZ)", "does not read it"}},
      {"web_page", "a.stl", "<!DOCTYPE html>\n<html></html>", {"a web page"}},
      {"git_lfs_pointer",
       "a.ply",
       "version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
       {"a pointer of Git LFS", "git lfs pull"}},
      {"vtp_unstructured",
       "a.vtp",
       "<VTKFile type=\"UnstructuredGrid\"/>",
       {"UnstructuredGrid", "Extract Surface"}},
      {"vtp_without_data", "a.vtp", "<VTKFile type=\"PolyData\"/>", {"line 1", "<PolyData>"}},
      {"vtp_of_too_many_points",
       "a.vtp",
       vtp_that_announces("Piece NumberOfPoints=\"8\"", "Float64", {2, 30000, 30000, 100, 100}),
       {"line 2", "7500 values", "24, as its piece says"}},
      {"vtp_that_would_take_all_memory",
       "a.vtp",
       vtp_that_announces("Piece", "UInt8",
                          std::vector<std::uint32_t>{16, 4294967295U, 0, 9, 9, 9, 9, 9, 9, 9, 9, 9,
                                                     9, 9, 9, 9, 9, 9, 9}),
       {"a.vtp, unpacked", "no honest file"}},
      {"vtk_grid",
       "a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n",
       {"line 4", "STRUCTURED_GRID", "Extract Surface"}},
      {"vtk_points",
       "a.vtk",
       "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n1234",
       {"4 bytes after byte 68", "9 there"}},
      {"vtk_huge",
       "a.vtk",
       "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 99999999 float\n1234",
       {"line 5", "fits into the file"}},
      {"vtk_cell",
       "a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n" + points +
           "POLYGONS 1 4\n9 0 1 2\n",
       {"line 9", "a cell of 9"}},
      {"vtk_index",
       "a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n" + points +
           "POLYGONS 1 4\n3 0 1 3\n",
       {"point index 3", "from 0 to 3 - 1"}},
      {"gzip_truncated",
       "a.obj.gz",
       std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03\x4b", 11),
       {"a.obj.gz"}},
      {"gzip_garbage",
       "a.obj.gz",
       std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10) + "garbage garbage",
       {"a.obj.gz"}},
  };
}

class BrokenFile : public testing::TestWithParam<Broken> {};

TEST_P(BrokenFile, IsRefusedByNameAndPlace) {
  const OwnFolder folder;
  const std::string message = refusal(folder.write(GetParam().file, GetParam().bytes));
  EXPECT_NE(message.find(GetParam().file), std::string::npos) << message;
  for (const std::string& part : GetParam().said) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrokenFile, testing::ValuesIn(broken_files()),
                         [](const auto& test) { return test.param.name; });

TEST(Reading, RefusesWhatIsNoReadableFile) {
  const OwnFolder folder;
  EXPECT_NE(refusal(folder.path() / "missing.obj").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("a directory"), std::string::npos);
}

TEST(Reading, RefusesAFileThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  const OwnFolder folder;
  const auto file = folder.write("secret.obj", encodings::obj());
  ::chmod(file.c_str(), 0);
  EXPECT_NE(refusal(file).find("Permission denied"), std::string::npos);
}

}  // namespace
}  // namespace curveskel::broken_files_laws
