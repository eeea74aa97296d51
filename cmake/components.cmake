# Components of the installed package: find_package(strainwave COMPONENTS forward) asks for no library that only the others use.
#   forward    gear files, the forward model with its derivatives
#   tolerance  errors of manufacture and mounting
#   export     results as JSON and HDF5, fields, decks, outlines
#   optimize   searches
#   studies    studies and their folders
# A room belongs to the first component whose rooms use it, so the first lines need not name what they stand on.
set(strainwave_components forward tolerance export optimize studies)
set(strainwave_component_forward model/gear_file model/forward)
set(strainwave_component_tolerance model/tolerance)
set(strainwave_component_export model/export)
set(strainwave_component_optimize "optimize/.*")
set(strainwave_component_studies ".*") # and whatever is in no other

# The rooms of a component by its patterns, with all that they use.
function(strainwave_closure_of component result)
  get_property(rooms GLOBAL PROPERTY STRAINWAVE_ROOMS)
  set(open "")
  foreach(pattern ${strainwave_component_${component}})
    set(matching ${rooms})
    list(FILTER matching INCLUDE REGEX "^${pattern}$")
    if(NOT matching)
      message(FATAL_ERROR "cmake/components.cmake: there is no room ${pattern}")
    endif()
    list(APPEND open ${matching})
  endforeach()
  set(closed "")
  while(open)
    list(POP_FRONT open room)
    if(NOT room IN_LIST closed)
      list(APPEND closed ${room})
      get_property(uses GLOBAL PROPERTY STRAINWAVE_USES_${room})
      list(APPEND open ${uses})
    endif()
  endwhile()
  set(${result} ${closed} PARENT_SCOPE)
endfunction()

# strainwave_component_<name>_rooms: its own; …_needs: the components that it stands on; …_libraries: from outside.
set(taken "")
foreach(component ${strainwave_components})
  strainwave_closure_of(${component} closure)
  set(strainwave_component_${component}_rooms "")
  set(strainwave_component_${component}_needs "")
  set(strainwave_component_${component}_libraries "")
  foreach(room ${closure})
    if(NOT room IN_LIST taken)
      list(APPEND taken ${room})
      list(APPEND strainwave_component_${component}_rooms ${room})
      set(component_of_${room} ${component})
      get_property(libraries GLOBAL PROPERTY STRAINWAVE_LIBRARIES_${room})
      list(APPEND strainwave_component_${component}_libraries ${libraries})
    elseif(NOT component_of_${room} STREQUAL component)
      list(APPEND strainwave_component_${component}_needs ${component_of_${room}})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES strainwave_component_${component}_needs)
  list(REMOVE_DUPLICATES strainwave_component_${component}_libraries)
endforeach()
