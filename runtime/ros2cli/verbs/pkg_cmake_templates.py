"""Templates for the files of a new package that CMake builds."""

from __future__ import annotations

from string import Template

LINTERS = """\
  <test_depend>ament_lint_auto</test_depend>
  <test_depend>ament_lint_common</test_depend>

"""
HEAD = Template("""\
cmake_minimum_required(VERSION 3.8)
project($name VERSION 0.0.0)

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()

# dependencies
$find""")
NO_FIND = "# find_package(<dependency> REQUIRED)\n"
LIBRARY = Template("""\
add_library($library ${kind}src/$library.cpp)
add_library($name::$library ALIAS $library)
target_compile_features($library PUBLIC c_std_99 cxx_std_17)
target_include_directories($library PUBLIC
  $$<BUILD_INTERFACE:$${CMAKE_CURRENT_SOURCE_DIR}/include>
  $$<INSTALL_INTERFACE:$include>)
$use# on Windows the macros of visibility_control.h export while the library is built, and import where it is used
target_compile_definitions($library PRIVATE "${macro}_BUILDING_LIBRARY")
install(
  DIRECTORY include/
  DESTINATION $include
)
install(
  TARGETS $library
  EXPORT export_$${PROJECT_NAME}
  ARCHIVE DESTINATION lib
  LIBRARY DESTINATION lib
  RUNTIME DESTINATION bin
)
""")
NODE = Template("""\
add_executable($node src/$node.cpp)
target_compile_features($node PUBLIC c_std_99 cxx_std_17)
target_include_directories($node PUBLIC
  $$<BUILD_INTERFACE:$${CMAKE_CURRENT_SOURCE_DIR}/include>
  $$<INSTALL_INTERFACE:$include>)
$link${node_use}install(TARGETS $node
  DESTINATION lib/$${PROJECT_NAME})
""")
AMENT_TESTS = """\
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  # a new package has no copyright lines yet, and may be no git repository
  set(ament_cmake_copyright_FOUND TRUE)
  set(ament_cmake_cpplint_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()
"""
AMENT_EXPORTS = Template("""\
ament_export_include_directories(
  "include/$${PROJECT_NAME}"
)
ament_export_libraries(
  $library
)
ament_export_targets(
  export_$${PROJECT_NAME}
)
""")
AMENT_END = "ament_package()\n"
EXPORT = """\
install(EXPORT export_${PROJECT_NAME}
  NAMESPACE ${PROJECT_NAME}::
  DESTINATION share/${PROJECT_NAME}/cmake)
"""
CONFIG_INSTALL = """\
# what find_package() of other packages reads
include(CMakePackageConfigHelpers)
configure_package_config_file(
  ${PROJECT_NAME}Config.cmake.in
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}Config.cmake
  INSTALL_DESTINATION share/${PROJECT_NAME}/cmake)
configure_file(
  ${PROJECT_NAME}ConfigVersion.cmake.in
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake
  @ONLY)
install(
  FILES
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}Config.cmake
  ${PROJECT_BINARY_DIR}/${PROJECT_NAME}ConfigVersion.cmake
  DESTINATION share/${PROJECT_NAME}/cmake)
"""
CONFIG = """\
@PACKAGE_INIT@

include(CMakeFindDependencyMacro)
{again}"""
CONFIG_TARGETS = """\
include("${{CMAKE_CURRENT_LIST_DIR}}/export_{name}.cmake")
set({name}_LIBRARIES {name}::{library})
"""
CONFIG_VERSION = """\
set(PACKAGE_VERSION "@PROJECT_VERSION@")
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
"""
NODE_CPP = Template("""\
#include <cstdio>

int main()
{
  printf("hello world $name package\\n");
  return 0;
}
""")
LIBRARY_HPP = Template("""\
#ifndef ${guard}_HPP_
#define ${guard}_HPP_

#include "$name/visibility_control.h"

namespace $name
{

class ${macro}_PUBLIC $class_name
{
public:
  $class_name();

  virtual ~$class_name();
};

}  // namespace $name

#endif  // ${guard}_HPP_
""")
LIBRARY_CPP = Template("""\
#include "$name/$library.hpp"

namespace $name
{

$class_name::$class_name()
{
}

$class_name::~$class_name()
{
}

}  // namespace $name
""")
VISIBILITY = Template("""\
#ifndef ${macro}__VISIBILITY_CONTROL_H_
#define ${macro}__VISIBILITY_CONTROL_H_

// What a shared library shows to those who use it: all but what is LOCAL where others than Windows compile it.
#if defined _WIN32 || defined __CYGWIN__
  #ifdef ${macro}_BUILDING_LIBRARY
    #define ${macro}_PUBLIC __declspec(dllexport)
  #else
    #define ${macro}_PUBLIC __declspec(dllimport)
  #endif
  #define ${macro}_LOCAL
#else
  #define ${macro}_PUBLIC __attribute__ ((visibility("default")))
  #define ${macro}_LOCAL __attribute__ ((visibility("hidden")))
#endif

#endif  // ${macro}__VISIBILITY_CONTROL_H_
""")
