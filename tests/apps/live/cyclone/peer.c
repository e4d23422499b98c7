/* SPDX-FileCopyrightText: 2026 The Heel authors
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * A robot by another maker of DDS: sends scans until a velocity comes, prints it, and ends.
 *   peer DOMAIN
 */
#include "messages.h"

#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char** argv) {
  const dds_domainid_t domain = argc > 1 ? (dds_domainid_t)atoi(argv[1]) : 0;
  const dds_entity_t peer = dds_create_participant(domain, NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  const dds_entity_t scans = dds_create_writer(
      peer,
      dds_create_topic(peer, &sensor_msgs_msg_dds__LaserScan__desc, "rt/scan", NULL, NULL), qos,
      NULL);
  const dds_entity_t commands = dds_create_reader(
      peer, dds_create_topic(peer, &geometry_msgs_msg_dds__Twist__desc, "rt/cmd_vel", NULL, NULL),
      NULL, NULL);
  float ranges[] = {1.5f, 2.5f, 3.5f};
  sensor_msgs_msg_dds__LaserScan_ scan = {0};
  scan.header.stamp.sec = 12;
  scan.header.stamp.nanosec = 500000000;
  scan.header.frame_id = "laser";
  scan.angle_min = -1.0f;
  scan.angle_max = 1.0f;
  scan.angle_increment = 1.0f;
  scan.range_max = 8.0f;
  scan.ranges._buffer = ranges;
  scan.ranges._length = scan.ranges._maximum = 3;
  for (int i = 0; i < 600; ++i) {
    dds_write(scans, &scan);
    void* samples[1] = {NULL};
    dds_sample_info_t info;
    if (dds_take(commands, samples, &info, 1, 1) > 0 && info.valid_data) {
      const geometry_msgs_msg_dds__Twist_* twist = samples[0];
      printf("%.3f %.3f\n", twist->linear.x, twist->angular.z);
      return 0;
    }
    dds_sleepfor(DDS_MSECS(50));
  }
  return 1;
}
