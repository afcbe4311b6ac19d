"""The files that `pkg create` writes for CMake packages; interface packages among them run here without a build."""

from __future__ import annotations

from collections.abc import Mapping
from string import Template

PACKAGE_XML = Template("""\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format$format.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="$format">
  <name>$name</name>
  <version>0.0.0</version>
  <description>$description</description>
  <maintainer email="$email">$maintainer</maintainer>
  <license>$license</license>

  <buildtool_depend>$buildtool</buildtool_depend>

$dependencies$tests  <export>
    <build_type>$build_type</build_type>
  </export>
</package>
""")
LINTERS = """\
  <test_depend>ament_lint_auto</test_depend>
  <test_depend>ament_lint_common</test_depend>

"""
CMAKE_LISTS = Template("""\
cmake_minimum_required(VERSION 3.8)
project($name)

if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic)
endif()

# dependencies
$find$library$node$end""")
AMENT_END = """\
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  # a new package has no copyright lines yet, and may be no git repository
  set(ament_cmake_copyright_FOUND TRUE)
  set(ament_cmake_cpplint_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()

ament_package()
"""
NODE_CMAKE = Template("""\
add_executable($node src/$node.cpp)
target_include_directories($node PUBLIC
  $$<BUILD_INTERFACE:$${CMAKE_CURRENT_SOURCE_DIR}/include>
  $$<INSTALL_INTERFACE:include/$${PROJECT_NAME}>)
target_compile_features($node PUBLIC c_std_99 cxx_std_17)
${uses}install(TARGETS $node
  DESTINATION lib/$${PROJECT_NAME})

""")
LIBRARY_CMAKE = Template("""\
add_library($library src/$library.cpp)
target_include_directories($library PUBLIC
  $$<BUILD_INTERFACE:$${CMAKE_CURRENT_SOURCE_DIR}/include>
  $$<INSTALL_INTERFACE:include/$${PROJECT_NAME}>)
target_compile_features($library PUBLIC c_std_99 cxx_std_17)
${uses}install(TARGETS $library
  DESTINATION lib)

""")
NODE_CPP = Template("""\
#include <cstdio>

int main()
{
  printf("hello world $name package\\n");
  return 0;
}
""")
LIBRARY_HPP = Template("""\
#ifndef ${guard}_
#define ${guard}_

namespace $name
{

class $class_name
{
public:
  $class_name();
};

}  // namespace $name

#endif  // ${guard}_
""")
LIBRARY_CPP = Template("""\
#include "$name/$library.hpp"

namespace $name
{

$class_name::$class_name()
{
}

}  // namespace $name
""")


def files(
    words: Mapping[str, str], build_type: str, dependencies: list[str], node: str, library: str
) -> dict[str, str]:
    """The texts of the files by their paths in the package; `words` are those of `pkg create`."""
    name, ament = words["name"], build_type == "ament_cmake"
    found = [*(["ament_cmake"] if ament else []), *dependencies]
    uses = f"ament_target_dependencies(\n  {{}}\n  {' '.join(dependencies)}\n)\n" if ament and dependencies else ""
    filled = {
        **words,
        "buildtool": "ament_cmake" if ament else "cmake",
        "build_type": build_type,
        "tests": LINTERS if ament else "",
    }
    made = {"package.xml": PACKAGE_XML.substitute(filled)}
    library_words = {
        "name": name,
        "library": library,
        "class_name": "".join(each.capitalize() for each in library.split("_")),
        "guard": f"{name}__{library}_HPP".upper(),
        "uses": uses.format(library),
    }
    if library:
        made[f"include/{name}/{library}.hpp"] = LIBRARY_HPP.substitute(library_words)
        made[f"src/{library}.cpp"] = LIBRARY_CPP.substitute(library_words)
    if node:
        made[f"src/{node}.cpp"] = NODE_CPP.substitute(name=name)
    made["CMakeLists.txt"] = CMAKE_LISTS.substitute(
        name=name,
        find="".join(f"find_package({each} REQUIRED)\n" for each in found) + "\n",
        library=LIBRARY_CMAKE.substitute(library_words) if library else "",
        node=NODE_CMAKE.substitute(node=node, uses=uses.format(node)) if node else "",
        end=AMENT_END if ament else "",
    )
    return made
