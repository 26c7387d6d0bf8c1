// Laws of writing: the whole file or none of it, and surfaces come back as they were.
#include <curveskel/advanced/write_file.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/write_surface.hpp>
#include "tests/own_folder.hpp"

namespace curveskel::write_file_laws {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  static std::string content(const fs::path& file) {
    std::string bytes(fs::file_size(file), '\0');
    std::ifstream(file, std::ios::binary).read(bytes.data(), std::ssize(bytes));
    return bytes;
  }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  }
  static std::string failure(const fs::path& file, std::string_view bytes) {
    try {
      write_file(file, bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::output);
      return error.what();
    }
    return "written";
  }

 private:
  OwnFolder own_;

 protected:
  fs::path folder = own_.path();
};

// The unfinished file's name was longer than the file's, and than file systems allow.
TEST_F(WriteFile, WritesNamesAsLongAsTheFileSystemAllows) {
  const std::string name(255, 'n');
  write_file(folder / name, "bytes");
  EXPECT_EQ(content(folder / name), "bytes");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, PutsExactlyTheseBytesThere) {
  std::string bytes(300000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 3U);
  write_file(folder / "new", bytes);
  EXPECT_EQ(content(folder / "new"), bytes);
  write_file(folder / "new", "");
  EXPECT_EQ(content(folder / "new"), "");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, LeavesWhatWasThereWhenTheDiskIsFull) {
  const fs::path file = folder / "old";
  write_file(file, "old content");
  // In a process of its own the limit on a file's size stands in for the disk's.
  const auto write_too_much = [&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit most{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &most);
    const std::string message = failure(file, std::string(5000, 'x'));
    std::fputs(message.c_str(), stderr);
    std::_Exit(content(file) == "old content" && files() == 1 ? 0 : 1);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(write_too_much(), testing::ExitedWithCode(0),
              "old: cannot be written \\(File too large\\); free some space");
}

TEST_F(WriteFile, SaysWhenADeviceIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_EQ(failure("/dev/full", "x"),
            "/dev/full: cannot be written (No space left on device); free some space or write "
            "elsewhere");
}

TEST_F(WriteFile, SaysWhatIsInTheWay) {
  EXPECT_NE(failure(folder, "x").find("Is a directory"), std::string::npos);
  EXPECT_NE(failure(folder / "none" / "file", "x").find("No such file or directory"),
            std::string::npos);
  write_file(folder / "file", "y");
  EXPECT_NE(failure(folder / "file" / "below", "x").find("Not a directory"), std::string::npos);
  EXPECT_NE(failure("", "x").find("No such file"), std::string::npos);
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, RespectsAFolderThatIsClosed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(failure(folder / "file", "x").find("Permission denied"), std::string::npos);
}

TEST_F(WriteFile, FollowsLinksAndKeepsPermissions) {
  fs::create_directory(folder / "other");
  write_file(folder / "other" / "real", "1");
  fs::permissions(folder / "other" / "real", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("other/real", folder / "link");
  write_file(folder / "link", "2");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "other" / "real"), "2");
  EXPECT_EQ(fs::status(folder / "other" / "real").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(WriteFile, GivesANewFileTheUsualPermissions) {
  const mode_t mask = umask(0027);
  write_file(folder / "new", "1");
  umask(mask);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "new").permissions()), 0640U);
}

TEST_F(WriteFile, WritesIntoWhatIsNoRegularFile) {
  write_file("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

Surface bipyramid() {
  Surface surface;
  surface.positions.resize(5, 3);
  surface.positions << 1, 0, 0, -0.5, 1.0 / 3, 1e-300, -0.5, -0.8660254037844386, 1e17, 0.1, 0.2,
      1.5, 0, -7e-9, -1.5;
  surface.triangles.resize(6, 3);
  surface.triangles << 0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4;
  return surface;
}

TEST_F(WriteFile, SurfacesComeBackToTheLastBit) {
  const Surface surface = bipyramid();
  for (const auto format :
       {SurfaceFormat::obj, SurfaceFormat::off, SurfaceFormat::ply, SurfaceFormat::om}) {
    const fs::path file = folder / ("s." + std::string(name_of(surface_formats, format)));
    write_file(file, format_surface(surface, format, "made by a\nv 9 9 9\rtest"));
    const PolygonSoup soup = read_polygons(file, {});
    EXPECT_EQ(soup.format, format);
    ASSERT_EQ(soup.positions.rows(), surface.positions.rows()) << file;
    EXPECT_TRUE((soup.positions.array() == surface.positions.array()).all()) << file;
    EXPECT_TRUE(std::equal(soup.corners.begin(), soup.corners.end(), surface.triangles.data(),
                           surface.triangles.data() + surface.triangles.size()))
        << file;
  }
}

TEST_F(WriteFile, StlHoldsEveryTriangleInSinglePrecision) {
  const Surface surface = bipyramid();
  write_file(folder / "s.stl", format_surface(surface, SurfaceFormat::stl, "solid"));
  const PolygonSoup soup = read_polygons(folder / "s.stl", {});
  EXPECT_EQ(soup.format, SurfaceFormat::stl);
  ASSERT_EQ(soup.corners.size(), 18U);
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    const auto corner = static_cast<Eigen::Index>(c);
    const auto expected = surface.positions.row(surface.triangles(corner / 3, corner % 3));
    EXPECT_EQ(soup.positions.row(soup.corners[c]).cast<float>(), expected.cast<float>());
  }
}

TEST_F(WriteFile, StlIsRefusedWhereSinglePrecisionMovesVertices) {
  Surface surface = bipyramid();
  surface.positions(2, 2) = 0;
  EXPECT_NO_THROW((void)format_surface(surface, SurfaceFormat::stl));
  for (const double far : {1e6, 1e39}) {
    Surface moved = surface;
    moved.positions.array() += far;
    EXPECT_THROW((void)format_surface(moved, SurfaceFormat::stl), Error);
    EXPECT_NO_THROW((void)format_surface(moved, SurfaceFormat::ply));
    moved.positions = moved.positions.cast<float>().cast<double>();  // as an STL file is read
    EXPECT_EQ(moved.positions.allFinite(), far < 1e38);
    if (far < 1e38) {
      EXPECT_NO_THROW((void)format_surface(moved, SurfaceFormat::stl));
    }
  }
}

TEST_F(WriteFile, SurfaceFormatsThatAreOnlyReadSaySo) {
  EXPECT_THROW((void)format_surface(bipyramid(), SurfaceFormat::glb), Error);
  EXPECT_THROW((void)format_surface(bipyramid(), SurfaceFormat::gltf), Error);
}

}  // namespace
}  // namespace curveskel::write_file_laws
