# Where OpenCASCADE is: FOOTPOINT_OCCT_FOUND, and footpoint_link_opencascade(<target> <toolkits...>).
find_path(FOOTPOINT_OCCT_INCLUDE ShapeAnalysis_Surface.hxx PATH_SUFFIXES opencascade)
find_library(FOOTPOINT_OCCT_OFFSET TKOffset)
set(FOOTPOINT_OCCT_FOUND OFF)
if(FOOTPOINT_OCCT_INCLUDE AND FOOTPOINT_OCCT_OFFSET)
  set(FOOTPOINT_OCCT_FOUND ON)
endif()

function(footpoint_link_opencascade target)
  get_filename_component(directory ${FOOTPOINT_OCCT_OFFSET} DIRECTORY)
  target_include_directories(${target} SYSTEM PRIVATE ${FOOTPOINT_OCCT_INCLUDE})
  target_link_directories(${target} PRIVATE ${directory})
  target_link_libraries(${target} PRIVATE ${ARGN})
endfunction()
