#include "petrous/Scene/ImagePart.h"

namespace petrous::scene
{

void saltIdentity(ImagePart& image, const IdentitySalt& salt)
{
  if (image.isFrameSalted)
    return;
  PatientHash& patient = image.patient;
  for (std::string* hash :
       {&image.frameOfReference, &patient.id, &patient.issuer, &patient.name, &patient.birthDate})
    if (!hash->empty())
      *hash = salt(*hash);
  for (std::string& hash : patient.nameParts)
    hash = salt(hash);
  image.isFrameSalted = true;
  if (hasSaltedIdentity(image))
    image.saltId = salt.id();
}

bool isComparable(const ImagePart& image, const IdentitySalt& salt)
{
  return !hasSaltedIdentity(image) || (salt && image.saltId == salt.id());
}

bool hasSaltedIdentity(const ImagePart& image)
{
  return image.isFrameSalted && (!image.frameOfReference.empty() || !image.patient.empty() ||
                                 !image.patient.nameParts.empty());
}

void forgetIdentity(ImagePart& image)
{
  image.frameOfReference.clear();
  image.patient = {};
  image.saltId.clear();
}

} // namespace petrous::scene
