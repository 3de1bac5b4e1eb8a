#include "petrous/Scene/ImagePart.h"

namespace petrous::scene
{

void saltIdentity(ImagePart& image, const std::function<std::string(const std::string&)>& salted)
{
  PatientHash& patient = image.patient;
  for (std::string* hash :
       {&image.frameOfReference, &patient.id, &patient.issuer, &patient.name, &patient.birthDate})
    if (!image.isFrameSalted && !hash->empty())
      *hash = salted(*hash);
  for (std::string& hash : patient.nameParts)
    if (!image.isFrameSalted)
      hash = salted(hash);
  image.isFrameSalted = true;
}

void forgetIdentity(ImagePart& image)
{
  image.frameOfReference.clear();
  image.patient = {};
}

} // namespace petrous::scene
