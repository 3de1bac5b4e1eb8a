#pragma once

#include "petrous/Imaging/PatientKey.h"
#include "petrous/Scene/ImagePart.h"

namespace petrous::presenters
{

/// What a case keeps of a patient before its library salts it.
scene::PatientHash patientHash(const imaging::PatientKey& key);

} // namespace petrous::presenters
