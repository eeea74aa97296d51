#pragma once
// The cup's displacement and stress in the states of the contact analysis: assembled on the wave generator,
// and under each load of the gear. The contact forces act through the same functionals that contact worked
// with (wall hats, flank hats, both lobes), so the fields' mean displacement at a contact is the contact's
// own displacement: the largest difference is the field's certificate.

#include "strainwave/model/export/vtkhdf.hpp"
#include "strainwave/model/flexspline/cyclic_field.hpp"
#include "strainwave/model/loading/contact_forces.hpp"

#include <string>
#include <vector>

namespace strainwave {

struct CupFields {
  SectorMesh mesh;
  std::vector<std::string> names; ///< of the states; columns of the fields
  RingField field;
  Eigen::MatrixXd von_mises_mpa; ///< largest in every element
  /// Wall displacement measured on the field against the contact analysis', largest over all states, mm.
  double contact_difference_mm = 0.0;
};

Outcome<CupFields> cup_fields(const ContactStates& states);

/// The ring's grid with, for each state NAME: point data NAME_displacement_mm, NAME_contact_force_n (nodal
/// forces on wall and flanks); cell data NAME_von_mises_mpa.
UnstructuredGrid field_grid(const CupFields& fields);

} // namespace strainwave
