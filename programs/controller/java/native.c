/* SPDX-License-Identifier: MIT
 * libJavaController.so: libcontroller's functions for Java. generate.py makes what is the same for all of them,
 * natives.inc; here is the rest: texts, and what is read from the library's memory.
 */
#include <jni.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/public.h"

/* --- texts: Java's are UTF-16, the library's UTF-8 */

/* A copy to be freed; null for null. */
static const char* text_of(JNIEnv* env, jstring text) {
  jclass kind;
  jmethodID bytes_of;
  jbyteArray bytes;
  jsize size;
  char* copy;
  if (!text) return 0;
  kind = (*env)->GetObjectClass(env, text);
  bytes_of = (*env)->GetMethodID(env, kind, "getBytes", "(Ljava/lang/String;)[B");
  bytes = (jbyteArray)(*env)->CallObjectMethod(env, text, bytes_of, (*env)->NewStringUTF(env, "UTF-8"));
  if (!bytes) return 0;
  size = (*env)->GetArrayLength(env, bytes);
  copy = malloc((size_t)size + 1);
  if (!copy) abort();
  (*env)->GetByteArrayRegion(env, bytes, 0, size, (jbyte*)copy);
  copy[size] = 0;
  return copy;
}

static jbyteArray bytes_for(JNIEnv* env, const void* bytes, size_t size) {
  jbyteArray array = (*env)->NewByteArray(env, (jsize)size);
  if (array && size) (*env)->SetByteArrayRegion(env, array, 0, (jsize)size, bytes);
  return array;
}

static jstring text_for(JNIEnv* env, const char* text) {
  jclass kind;
  jmethodID make;
  if (!text) return 0;
  kind = (*env)->FindClass(env, "java/lang/String");
  make = (*env)->GetMethodID(env, kind, "<init>", "([BLjava/lang/String;)V");
  return (jstring)(*env)->NewObject(env, kind, make, bytes_for(env, text, strlen(text)),
                                    (*env)->NewStringUTF(env, "UTF-8"));
}

#include "natives.inc"

/* --- what is read from the library's memory; null where there is none */

static jdoubleArray JNICALL m_numbers(JNIEnv* env, jclass self, jlong address, jint count) {
  jdoubleArray array = address ? (*env)->NewDoubleArray(env, count) : 0;
  (void)self;
  if (array) (*env)->SetDoubleArrayRegion(env, array, 0, count, (const jdouble*)(intptr_t)address);
  return array;
}

static jintArray JNICALL m_ints(JNIEnv* env, jclass self, jlong address, jint count) {
  jintArray array = address ? (*env)->NewIntArray(env, count) : 0;
  (void)self;
  if (array) (*env)->SetIntArrayRegion(env, array, 0, count, (const jint*)(intptr_t)address);
  return array;
}

static jbyteArray JNICALL m_bytes(JNIEnv* env, jclass self, jlong address, jint count) {
  (void)self;
  return address ? bytes_for(env, (const void*)(intptr_t)address, (size_t)count) : 0;
}

/* What was recognised: for each object its id, position, orientation, size, place and size on the picture, number of
 * colours; and then its colours. Its model apart. */
static const WbCameraRecognitionObject* recognised(jlong address, jint index) {
  return (const WbCameraRecognitionObject*)(intptr_t)address + index;
}
static jdoubleArray JNICALL m_recognised(JNIEnv* env, jclass self, jlong address, jint index) {
  const WbCameraRecognitionObject* o = recognised(address, index);
  jsize colours = 3 * o->number_of_colors;
  jdoubleArray array = (*env)->NewDoubleArray(env, 15 + colours);
  double head[15] = {o->id, o->position[0], o->position[1], o->position[2], o->orientation[0], o->orientation[1],
                     o->orientation[2], o->orientation[3], o->size[0], o->size[1], o->position_on_image[0],
                     o->position_on_image[1], o->size_on_image[0], o->size_on_image[1], o->number_of_colors};
  (void)self;
  if (!array) return 0;
  (*env)->SetDoubleArrayRegion(env, array, 0, 15, head);
  if (colours) (*env)->SetDoubleArrayRegion(env, array, 15, colours, o->colors);
  return array;
}
static jstring JNICALL m_recognised_model(JNIEnv* env, jclass self, jlong address, jint index) {
  const char* model = recognised(address, index)->model;
  (void)self;
  return text_for(env, model ? model : "");
}

/* Of each point x, y, z and the node's number. */
static jdoubleArray JNICALL m_contacts(JNIEnv* env, jclass self, jlong node, jboolean with_descendants) {
  int count = 0;
  const WbContactPoint* points =
      wb_supervisor_node_get_contact_points((WbNodeRef)(intptr_t)node, with_descendants != 0, &count);
  jdoubleArray array = (*env)->NewDoubleArray(env, points ? 4 * count : 0);
  (void)self;
  for (int i = 0; array && points && i < count; i++) {
    double four[4] = {points[i].point[0], points[i].point[1], points[i].point[2], points[i].node_id};
    (*env)->SetDoubleArrayRegion(env, array, 4 * i, 4, four);
  }
  return array;
}

static const JNINativeMethod kMemory[] = {
    {"numbers", "(JI)[D", (void*)m_numbers},
    {"ints", "(JI)[I", (void*)m_ints},
    {"bytes", "(JI)[B", (void*)m_bytes},
    {"recognised", "(JI)[D", (void*)m_recognised},
    {"recognisedModel", "(JI)Ljava/lang/String;", (void*)m_recognised_model},
    {"contacts", "(JZ)[D", (void*)m_contacts},
};

#define PACKAGE "com/cyberbotics/webots/controller/"

JNIEXPORT jint JNICALL JNI_OnLoad(JavaVM* machine, void* reserved) {
  JNIEnv* env;
  jclass natives, memory;
  (void)reserved;
  if ((*machine)->GetEnv(machine, (void**)&env, JNI_VERSION_1_8) != JNI_OK) return JNI_ERR;
  memory = (*env)->FindClass(env, PACKAGE "Memory");
  if (!memory || (*env)->RegisterNatives(env, memory, kMemory, sizeof kMemory / sizeof *kMemory) != 0) return JNI_ERR;
  natives = (*env)->FindClass(env, PACKAGE "Native");
  if (!natives || (*env)->RegisterNatives(env, natives, kNatives, sizeof kNatives / sizeof *kNatives) != 0)
    return JNI_ERR;
  return JNI_VERSION_1_8;
}
